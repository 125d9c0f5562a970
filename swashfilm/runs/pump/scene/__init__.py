"""The whole pump in space: solids of its parts with the films on them, as blocks for ParaView and for pictures."""
