"""The papers in float64, formula by formula: what the integer models are derived from and measured against."""
