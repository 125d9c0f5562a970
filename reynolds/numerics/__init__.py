"""General methods that know no film."""
