"""The head of a recording.toml of REF90, up to its channels."""

HEAD = """format = 1
title = "made"
pump = "ref90"
oil = "ISO VG 46"
pressure_reference = "gauge"

[steady]
file = "steady.csv"

[channel]
speed = { column = "n", unit = "rpm", sigma = 0.5 }
"""
