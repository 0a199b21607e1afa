import numpy as np
import pytest

import curveflow as cf


def scene(expression: object) -> cf.Scene:
    return cf.Scene(
        curve=cf.Ellipse((1.3, 0.9)),
        density=[cf.Density("protein", "0.5 + 0.1*cos(2*pi*s)", "diffusion")],
        energy=[cf.Local(expression)],  # type: ignore[arg-type] # some are none
        time=cf.Time(1e-4),
        accuracy=cf.Accuracy(nodes=64),
    )


def test_an_energy_of_ones_own_is_that_of_its_formula():
    own = scene("0.5*(kappa - sin(protein))^2 + 0.1*exp(-protein)*kappa_sigma^2 + 0.2*protein_sigma^2")
    result = cf.run(own)
    assert result.success and np.all(np.diff(result.energy) < 0)
    kappa, rho, length = result.curvature[0], result.density["protein"][0], result.length[0]

    def slope(values: np.ndarray) -> np.ndarray:
        return np.fft.irfft(2j * np.pi * np.arange(33) * np.fft.rfft(values), 64) / length

    density = 0.5 * (kappa - np.sin(rho)) ** 2 + 0.1 * np.exp(-rho) * slope(kappa) ** 2 + 0.2 * slope(rho) ** 2
    assert result.energy[0] == pytest.approx(density.mean() * length, rel=1e-9)


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("kappa**2", r"column 6: a power is written `\^`, as in `kappa\^2`, not `\*\*`"),
        ("np.exp(-kappa)", r"unknown name `np.exp` \(did you mean `exp`\?\)"),
        ("math.pi*kappa", r"unknown name `math.pi` \(did you mean `pi`\?\)"),
        ("log(protein)", r"unknown name `log` \(did you mean `ln`\?\)"),
        ("np.log(protein)", r"unknown name `np.log` \(did you mean `ln`\?\)"),
        ("κ^2", r"unknown name `κ` \(did you mean `kappa`\?\)"),
        ("kappa²", r"unknown name `kappa²` \(did you mean `kappa\^2`\?\)"),
        ("2 kappa", r"a product needs its `\*`"),
        ("rho^2", r"unknown name `rho`; allowed: kappa, kappa_sigma, protein, protein_sigma, pi, exp"),
        ("kappa < 1", r"found the character '<'; an expression has only numbers, names, \+ - \* / \^"),
        ("lambda kappa: kappa", r"unknown name `lambda`; allowed: kappa"),
    ],
)
def test_what_python_writes_is_told_what_to_write(written: str, told: str):
    with pytest.raises(cf.SceneError, match=rf"energy\.local\.expression.*{told}"):
        scene(written)


def test_functions_are_told_to_be_text():
    for function in (lambda kappa: kappa**2, np.exp):
        with pytest.raises(TypeError, match=r"energy\.local\.expression: a function cannot be differentiated; write"):
            scene(function)
