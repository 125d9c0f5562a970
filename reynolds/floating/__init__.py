"""A film whose walls move until forces balance: coordinates, implicit step, rest."""
