"""The lumped pump and the common parts of all fidelities: loads, power, efficiencies, assembly.

"The paper" is Xu, Hu, Zhang and Mao (2017), "Distribution characteristics and impact on pump's efficiency of
hydro-mechanical losses of axial piston pump over wide operating ranges", Journal of Central South University 24.
docs/theory.md lists its equations and their corrections.
"""
