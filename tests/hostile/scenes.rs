//! Small scenes that between them name every key.

const BENDING: &str = "
title = 'bending'
curve = { shape = 'ellipse', semi_axes = [1.5, 1.0], turning_number = 1 }
density = [
    { name = 'protein', initial = '0.5 + 0.1*cos(2*pi*s)', mobility = 'diffusion', weight = '1 + 0.5*cos(2*pi*s)' },
    { name = 'lipid', initial = 0.4, mobility = 'exchange' },
]
time = { end = 0.1, stop_at_equilibrium = true, equilibrium_tolerance = 1e-6, max_steps = 100 }
accuracy = { tolerance = 1e-3, nodes = 32, derivative = 'fourier', linear_solver = 'auto' }
output = { frames = 3, spacing = 'log', fields = ['normal-force', 'energy-densities'] }
[flow]
normal_mobility = 'identity'
gauge = 'graded'
grading = '1 + 0.2*cos(2*pi*s)'
stop_on_contact = true
switch = [{ time = 1e-6, gauge = 'graded', grading = 1 }, { time = 0.01, gauge = 'scaled-arc-length' }]
[energy]
bending = { rigidity = 1.0, preferred_curvature = '0.5*rho', density = 'protein' }
regularization = { delta = 0.1 }
length = { penalty = 3.0, target_ratio = 1.1 }
area = { penalty = 1.0, target_ratio = 0.9 }
packing = { matrix = [[1.0, 0.1], [0.1, 1.0]], epsilon = 0.1 }
local = { expression = 'kappa^4 + 0.1*kappa_sigma^2 + protein*lipid_sigma^2' }
";

const AGENTS: &str = "
curve = { shape = 'ellipse', semi_axes = [1.2, 1.0] }
density = [{ name = 'protein', initial = '0.5 + 0.1*cos(6*pi*s)', mobility = 'diffusion' }]
time.end = 0.1
accuracy = { tolerance = 1e-3, nodes = 32, linear_solver = 'banded' }
output.times = [0.01, 0.05]
[energy.length]
penalty = 3.0
target = 9.0
[energy.agents]
density = 'protein'
epsilon = 0.2
delta = 0.2
preferred_curvature = '1.3 - 2*rho'
low_density = '0.05 + 0.1*exp(-kappa^2)'
high_density = '0.8 + 0.1*exp(-kappa^2)'
";

const ADHESION: &str = "
curve = { shape = 'polar', r = '1 + 0.2*cos(2*phi)' }
time.end = 0.1
accuracy = { tolerance = 1e-3, nodes = 32, derivative = 'central-4', linear_solver = 'fourier' }
flow.gauge = 'co-moving'
flow.normal_mobility = 'area-preserving'
[energy]
bending.rigidity = 1.0
adhesion = { kernel = '(1 - q/0.25)*exp(-q/0.25)', cutoff = 2.0 }
area.pressure = 0.1
length.tension = 0.1
";

const MEMBRANE: &str = "
curve = { shape = 'parametric', x = '2*cos(phi)', y = 'sin(phi)' }
density = [{ name = 'membrane', initial = 1, mobility = 'diffusion' }]
time.end = 0.1
accuracy = { tolerance = 1e-3, nodes = 32 }
output.fields = ['excess-density', 'membrane-flux', 'tangential-velocity', 'normal-velocities']
[energy]
bending.rigidity = 1.0
membrane = { density = 'membrane', epsilon = 0.1 }
area = { penalty = 1.0, target = 6.0 }
";

const INCOMPRESSIBLE: &str = "
curve = { shape = 'figure-eight', size = 1.0 }
density = [{ name = 'dye', initial = 's*(1 - s)', mobility = 'none' }]
time.end = 0.1
accuracy = { tolerance = 1e-3, nodes = 32 }
flow.normal_mobility = 'incompressible'
[energy]
bending.rigidity = 1.0
";

const POINTS: &str = "
curve.shape = 'points'
curve.points = [[2.00000, 0.00000], [1.84776, 0.38268], [1.41421, 0.70711], [0.76537, 0.92388], [0.00000,
    1.00000], [-0.76537, 0.92388], [-1.41421, 0.70711], [-1.84776, 0.38268], [-2.00000, 0.00000], [-1.84776,
    -0.38268], [-1.41421, -0.70711], [-0.76537, -0.92388], [0.0, -1.00000], [0.76537, -0.92388], [1.41421,
    -0.70711], [1.84776, -0.38268]]
time.end = 0.1
accuracy = { tolerance = 1e-3, nodes = 32, linear_solver = 'dense' }
energy.bending.rigidity = 1.0
flow.normal_mobility = 'surface-diffusion'
";

const CIRCLE: &str = "
curve = { shape = 'circle', radius = 1.0 }
time.end = 0.1
energy.bending.rigidity = 1.0
accuracy.nodes = 32
flow.normal_mobility = 'incompressible-area-preserving'
";

pub const ALL: [&str; 7] = [BENDING, AGENTS, ADHESION, MEMBRANE, INCOMPRESSIBLE, POINTS, CIRCLE];
