"""Physics missing in loss models, as effects that extend the pump model."""
