"""Chamber traces as readings: rows, misfits, the bench that gives both."""
