"""Terminal output and options that commands share."""
