"""Chamber pressure over a periodic turn, with port volumes and lines."""
