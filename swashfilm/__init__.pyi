from .api.cases import reference as reference, reproduce as reproduce, transient as transient
from .api.drawings import optimise as optimise, sensitivity as sensitivity, tolerance as tolerance
from .api.errors import InputFaults as InputFaults, NotConverged as NotConverged
from .api.files import new as new, open as open
from .api.films import film as film, study as study
from .api.maps import compare as compare, duty as duty, export as export, map as map
from .api.pumps import load_pump as load_pump, run as run, table as table, vary as vary
from .api.recordings import calibrate as calibrate, diagnose as diagnose, plan as plan
from .runs.table.gap_run import read_gap_table as read_gap_table
from .version import __version__ as __version__
