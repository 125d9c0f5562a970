"""Linear systems of one sparsity: symmetric, general, cavitated, between elastic walls."""
