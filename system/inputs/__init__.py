"""Values from files: units, faults, TOML and CSV tables, channel names."""
