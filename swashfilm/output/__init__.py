"""Run folder, pages, figures, field maps, tables."""
