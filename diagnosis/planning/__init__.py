"""A campaign before the test: which suspects it tells apart, which points and sensors to add."""
