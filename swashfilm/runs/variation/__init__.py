"""Commands on varied pumps, `swashfilm sensitivity` and `tolerance`, and the inputs that both share."""
