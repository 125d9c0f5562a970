"""A campaign before the test: the suspects that it separates, the points and sensors to add."""
