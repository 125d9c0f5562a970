"""Film mesh and finite element space: unknowns, quadrature, sparsity, element loops."""
