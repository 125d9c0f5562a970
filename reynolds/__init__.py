"""One thin film: pressure from film thickness (Reynolds 1886). Independent of pumps."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
