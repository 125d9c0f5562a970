"""`swashfilm duty`: energies and losses of a pump over a duty cycle, by its map."""
