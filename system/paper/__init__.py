"""The paper's statements against the numbers of this program, and a judgement on each.

The paper is Xu, Hu, Zhang and Mao (2017), "Distribution characteristics and impact on pump's efficiency of
hydro-mechanical losses of axial piston pump over wide operating ranges", Journal of Central South University 24.
"""
