"""Sections: tables of a TOML file as frozen dataclasses in SI, read, written and described by one engine."""
