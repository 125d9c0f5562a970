"""A pump that knows nothing of the simulator: own geometry, own discretisation, own laws, own constants."""
