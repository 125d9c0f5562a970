"""The verdict as text, tables and diagnosis.json."""
