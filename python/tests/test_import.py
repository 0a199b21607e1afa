import subprocess
import sys

HEAVY = ("matplotlib", "xarray", "pandas", "h5netcdf", "h5py", "PIL", "imageio_ffmpeg", "IPython", "importlib.metadata")


def modules(code: str) -> set[str]:
    program = f"import sys; {code}; print(*sys.modules)"
    return set(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.split())


def test_nothing_heavy_is_imported_before_it_is_used():
    loaded = modules("import curveflow")
    assert "numpy" in loaded and "curveflow.operators" in loaded
    # What NumPy brings along is not ours to leave out.
    assert not (loaded - modules("import numpy")) & set(HEAVY)


def test_a_run_needs_numpy_alone():
    loaded = modules("import curveflow as cf; cf.run(cf.Scene.shipped('circle')).energy")
    assert not (loaded - modules("import numpy")) & set(HEAVY)
