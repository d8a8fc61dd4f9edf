"""Scene file whose start and run take a few milliseconds, for commands that run many designs."""

# a given stiffness saves nine tenths of the start-up time, and does not change mass and stress
SCENE = """description = "one spring per mesh, loaded"
stop_time = 0.001
step = 0.001
outputs = ["safety.root_min"]
[set]
scene.gear_contact = "lumped"
scene.planet_spin = "imposed"
spin.command = "200 deg/s"
effects.strength = true
contact.mesh_stiffness_from_geometry = false
left.load_torque = "835 N.m"
right.load_torque = "835 N.m"
"""
