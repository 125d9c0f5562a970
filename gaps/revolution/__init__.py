"""A gap over one turn: time march, periodic closure, heat, reports by angle."""
