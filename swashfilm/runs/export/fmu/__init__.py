"""A map as co-simulation unit by FMI 3.0: model description, C sources, binaries."""
