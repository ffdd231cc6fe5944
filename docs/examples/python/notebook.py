# %% [markdown]
# # A part, its edges, its pose, step by step
#
# Editors such as VS Code and Spyder run the cells one by one; `jupytext --to ipynb notebook.py`
# makes a notebook. As a program it writes the last picture:
#
#     python3 docs/examples/python/notebook.py OUT.png

# %%
import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000000"

# %% [markdown]
# ## The part
# A mesh has no unit of its own: say it. The diameter shows whether it was right.

# %%
mesh = edgescout.load_mesh(EXAMPLES / "parts/obj_000005.ply", unit="mm")
print(mesh, "corners from", mesh.vertices_m.min(axis=0), "to", mesh.vertices_m.max(axis=0))

# %% [markdown]
# ## The image and its camera

# %%
image = edgescout.load_image(scene / "gray/000000.png")
camera = edgescout.load_camera(scene / "scene_camera.json")
print(image.shape, image.dtype, "\n", camera.K)

# %% [markdown]
# ## Detection
# Options have the names of the command line. `help()` explains them.

# %%
distances = edgescout.TemplateOptions(distance_min=0.3, distance_max=0.38)
templates = edgescout.Templates(mesh, distances)
options = edgescout.DetectOptions(min_probability=0.05)
print(options.help()["min_probability"])
found = edgescout.detect(image, camera, templates, options)
for detection in found:
    sigma_mm = 1e3 * np.sqrt(np.diag(detection.covariance)[:3])
    print(f"{detection.name}: probability {detection.probability:.2f}, standard deviations along "
          f"the camera's axes {sigma_mm.round(2)} mm")

# %% [markdown]
# ## From a guess to the pose
# A pose that is 5 mm and 0.1 rad off comes back.

# %%
guess = found[0].world_from_object.copy()
guess[:3, 3] += 0.005, 0, 0
c, s = np.cos(0.1), np.sin(0.1)
guess[:3, :3] = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ guess[:3, :3]
refined = edgescout.register(image, camera, templates, [guess])[0]
off_mm = 1e3 * np.linalg.norm(refined.world_from_object[:3, 3] - found[0].world_from_object[:3, 3])
print(f"back within {off_mm:.2f} mm")

# %%
edgescout.save_png(edgescout.overlay(image, camera, found, templates), sys.argv[1])
