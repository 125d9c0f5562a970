"""Pictures of films over their plane, and of films and pump in space."""
