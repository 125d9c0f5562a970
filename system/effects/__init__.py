"""Physics that loss models leave out, as effects that extend the pump model."""
