"""Laws of the effects."""
