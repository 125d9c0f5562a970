"""First part of an operating point's page: tiles, words, and the flow diagram of the shaft power."""
