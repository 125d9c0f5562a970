"""Points from a time series: steady stretches, or quasi-steady means with the response of each meter."""
