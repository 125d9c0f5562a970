"""Geometry of the gaps without films: profiles, lands, valve plate ring, pads, mesh rows, orifices."""
