# %% [markdown]
# # A tour of Stilb in Python
#
# The cells of this file run in Jupyter, in VS Code and as a program. They need `pip install ".[notebook]"` in a clone of
# the project. Each takes a second or two.

# %%
import numpy as np

import stilb

# %% [markdown]
# ## A room in code
#
# Parts have the names and the keys of the [scene file](../../docs/scene-format.md). `stilb.load("office.toml")` reads one.

# %%
scene = stilb.Scene("room")
scene.materials["wall"] = stilb.Diffuse(reflectance=0.6)
scene.materials["oak"] = stilb.Plastic(diffuse=(0.35, 0.22, 0.12), ior=1.5, roughness=0.2)
scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")
scene.objects["desk"] = stilb.Box(min=(1, 1, 0), max=(2.6, 1.8, 0.75), material="oak")
scene.lights["bulb"] = stilb.SphereLight(center=(2, 1.5, 2.2), radius=0.1, flux=800)
scene.sensors["desk"] = stilb.Grid(corner=(1, 1, 0.76), edge_u=(1.6, 0, 0), edge_v=(0, 0.8, 0), count=(16, 8))
scene.sensors["door"] = stilb.Camera(position=(0.3, 0.3, 1.6), target=(2.5, 2, 0.8), fov=70, resolution=(120, 80))
print(scene, scene.check())

# %% [markdown]
# ## Illuminance with error bars

# %%
result = scene.measure(error=0.01, time=5)
desk = result["desk"]
low, high = desk.interval()
print(result)
print("mean", desk.mean, " uniformity", desk.uniformity)
print("the values", desk.value.shape, "have intervals of", float((high - low).mean()), desk.unit)
desk.plot()

# %% [markdown]
# The arrays are views of the library's memory. pandas gets a table with a row for each point:

# %%
print(desk.to_pandas().head(3))

# %% [markdown]
# ## What if
#
# Parts change by their attributes. The same seed and number of paths give the same random numbers, so that differences of
# variants are clearer than each of them.

# %%
for flux in (400, 800, 1200):
    scene.lights["bulb"].flux = flux
    print(flux, "lm:", scene.measure(paths=4096)["desk"].mean)

# %% [markdown]
# ## Any points
#
# Arrays go in, a reading with the same shape comes out.

# %%
x = np.linspace(0.2, 3.8, 10)
line = np.stack([x, np.full_like(x, 0.5), np.zeros_like(x)], axis=1)
floor = scene.illuminance(line, normals=(0, 0, 1), error=0.02, time=5)
print(np.round(floor.value, 1), "±", np.round(floor.standard_error, 1), floor.unit)
wall = scene.luminance((2, 1.5, 1.2), [(1, 0, 0), (-1, 0, 0)], error=0.02, time=5)
print(wall.value, wall.unit)

# %% [markdown]
# ## A mesh from arrays

# %%
angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
ring = np.stack([2 + 0.2 * np.cos(angle), 1.4 + 0.2 * np.sin(angle), np.full_like(angle, 0.76)], axis=1)
vertices = np.vstack([ring, [[2, 1.4, 1.1]]])
faces = [(i, (i + 1) % 24, 24) for i in range(24)]
scene.objects["cone"] = stilb.Mesh(vertices, faces, "wall")

# %% [markdown]
# ## Pictures

# %%
image = scene.render("door", paths=8)
print(image, "brightest:", float(np.nanmax(image.luminance)), "cd/m²")
image.plot()

# %% [markdown]
# A solution has the light of all viewpoints and of each lamp apart:

# %%
solution = scene.solve(paths=16, patch=0.7)
dimmed = solution.render("door", lights={"bulb": 0.25})
print(solution.lights, float(dimmed.luminance.mean() / solution.render("door").luminance.mean()))

# %% [markdown]
# ## Is it right?
#
# Problems with known answers are part of the package. Here the room is a sphere, in which all walls get the same indirect
# light, and the test tells how unlikely so large a difference is.

# %%
sphere = stilb.Scene("sphere")
sphere.materials["white"] = stilb.Diffuse(reflectance=0.8)
sphere.objects["wall"] = stilb.Sphere(center=(0, 0, 0), radius=1, material="white")
sphere.lights["lamp"] = stilb.PointLight(position=(0, 0, 0.5), flux=1000)
measured = sphere.illuminance((0, 0, -1), (0, 0, 1), error=0.01, time=5)
exact = stilb.exact.photometric_sphere(1, 0.8, 1000, source=(0, 0, 0.5), to_wall=(0, 0, -1))
z = (measured.value - exact) / measured.standard_error
print(f"{measured.value:.2f} ± {measured.standard_error:.2f} lx, exactly {exact:.2f} lx:",
      f"z = {z:.2f}, p = {stilb.statistics.two_sided_p_of_z(float(z)):.2f}")

# %% [markdown]
# ## What is wrong is said

# %%
scene.materials["wall"] = stilb.Diffuse(reflectence=0.6)
try:
    scene.measure()
except stilb.InputError as error:
    print(error)
