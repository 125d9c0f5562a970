"""The pump: description, kinematics, chambers, ports, friction pairs, losses and the coupled revolution."""
