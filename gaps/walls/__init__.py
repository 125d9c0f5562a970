"""Parts of a gap as elastic bodies, and the compliance of both of its walls."""
