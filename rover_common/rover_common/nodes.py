"""Names of the nodes, in the order of the data's flow."""

BRIDGE = "bridge_node"
PERCEPTION = "perception_node"
DECISION = "decision_node"
ROVER = (BRIDGE, PERCEPTION, DECISION)

BURGER = "burger_node"
NAVIGATOR = "navigator_node"
HEAT = "heat_node"
HEAT_TEAM = (BURGER, NAVIGATOR, HEAT)
