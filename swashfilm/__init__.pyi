from .api import (
    InputFaults as InputFaults,
    NotConverged as NotConverged,
    calibrate as calibrate,
    compare as compare,
    diagnose as diagnose,
    duty as duty,
    export as export,
    film as film,
    load_pump as load_pump,
    map as map,
    new as new,
    open as open,
    reference as reference,
    reproduce as reproduce,
    run as run,
    sensitivity as sensitivity,
    study as study,
    table as table,
    tolerance as tolerance,
    transient as transient,
)
from .runs.table.gap_run import read_gap_table as read_gap_table
from .version import __version__ as __version__
