"""Recording and simulator joined: readings, axes, traces, linear posterior."""
