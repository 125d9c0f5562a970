"""What the page of an operating point says first: tiles, words, and where the shaft power goes."""
