"""One thin film: pressure from film thickness (Reynolds 1886). Independent of pumps."""

from pathlib import Path

import lazy_loader

from reynolds.compiled.kernel_sources import discard_stale

discard_stale(Path(__file__).parents[1])  # before any compiled function is loaded

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
