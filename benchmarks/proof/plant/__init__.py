"""A pump independent of the simulator: own geometry, own discretisation, own laws, own constants."""

VERSION = 1
"""Of plant, campaigns and sensors: raised with every change of a reading."""
