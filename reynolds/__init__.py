"""One thin film: pressure from film thickness (Reynolds 1886). Knows nothing of pumps."""
