from .api import (
    InputFaults as InputFaults,
)
from .api import (
    NotConverged as NotConverged,
)
from .api import (
    calibrate as calibrate,
)
from .api import (
    compare as compare,
)
from .api import (
    diagnose as diagnose,
)
from .api import (
    duty as duty,
)
from .api import (
    film as film,
)
from .api import (
    load_pump as load_pump,
)
from .api import (
    map as map,
)
from .api import (
    open as open,
)
from .api import (
    reference as reference,
)
from .api import (
    reproduce as reproduce,
)
from .api import (
    run as run,
)
from .api import (
    study as study,
)
from .api import (
    table as table,
)
from .api import (
    transient as transient,
)
from .runs.table.gap_run import read_gap_table as read_gap_table
from .version import __version__ as __version__
