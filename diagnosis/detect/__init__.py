"""Detection: mismatch, its channel, region, component, shaft angle, time."""
