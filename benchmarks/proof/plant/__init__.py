"""A pump that knows nothing of the simulator: own geometry, own discretisation, own laws, own constants."""

VERSION = 1
"""Of plant, campaigns and sensors: raised with every change that moves a reading."""
