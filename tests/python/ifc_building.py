"""A small building in IFC: two storeys, a window, a luminaire."""

from pathlib import Path

import ifcopenshell
import ifcopenshell.api
import ifcopenshell.api.aggregate
import ifcopenshell.api.context
import ifcopenshell.api.feature
import ifcopenshell.api.geometry
import ifcopenshell.api.material
import ifcopenshell.api.pset
import ifcopenshell.api.root
import ifcopenshell.api.spatial
import ifcopenshell.api.unit
import numpy as np

LENGTH, WIDTH, STOREY, SLAB, WALL = 6.0, 4.0, 3.0, 0.2, 0.2  # m


class Builder:
    """Elements are boxes, in millimetres as many programs write them; `origin` [m] is where the building lies."""

    def __init__(self, origin):
        self.origin = np.asarray(origin)
        self.model = ifcopenshell.api.run("project.create_file", version="IFC4")
        self.project = ifcopenshell.api.root.create_entity(self.model, ifc_class="IfcProject", name="Two storeys")
        millimetre = ifcopenshell.api.unit.add_si_unit(self.model, unit_type="LENGTHUNIT", prefix="MILLI")
        ifcopenshell.api.unit.assign_unit(self.model, units=[millimetre])
        model3d = ifcopenshell.api.context.add_context(self.model, context_type="Model")
        self.body = ifcopenshell.api.context.add_context(self.model, context_type="Model", context_identifier="Body",
                                                         target_view="MODEL_VIEW", parent=model3d)
        self.building = ifcopenshell.api.root.create_entity(self.model, ifc_class="IfcBuilding", name="House")
        ifcopenshell.api.aggregate.assign_object(self.model, relating_object=self.project, products=[self.building])

    def storey(self, name):
        storey = ifcopenshell.api.root.create_entity(self.model, ifc_class="IfcBuildingStorey", name=name)
        ifcopenshell.api.aggregate.assign_object(self.model, relating_object=self.building, products=[storey])
        return storey

    def box(self, kind, name, least, most, storey=None, material=None):
        """A box between two corners [m]."""
        element = ifcopenshell.api.root.create_entity(self.model, ifc_class=kind, name=name)
        matrix = np.eye(4)
        matrix[:3, 3] = self.origin + least
        ifcopenshell.api.geometry.edit_object_placement(self.model, product=element, matrix=matrix)
        self.add_body(element, [b - a for a, b in zip(least, most)])
        if storey is not None and kind == "IfcSpace":
            ifcopenshell.api.aggregate.assign_object(self.model, relating_object=storey, products=[element])
        elif storey is not None:
            ifcopenshell.api.spatial.assign_container(self.model, products=[element], relating_structure=storey)
        if material is not None:
            ifcopenshell.api.material.assign_material(self.model, products=[element], material=material)
        return element

    def add_body(self, element, size, least=(0.0, 0.0, 0.0)):
        """A box of this size [m], from a corner relative to the element's place."""
        x, y, z = (1000 * length for length in size)
        profile = self.model.create_entity(
            "IfcRectangleProfileDef", ProfileType="AREA", XDim=x, YDim=y,
            Position=self.model.create_entity("IfcAxis2Placement2D",
                                              Location=self.model.create_entity("IfcCartesianPoint", (x / 2, y / 2))))
        solid = self.model.create_entity(
            "IfcExtrudedAreaSolid", SweptArea=profile, Depth=z,
            ExtrudedDirection=self.model.create_entity("IfcDirection", (0.0, 0.0, 1.0)),
            Position=self.model.create_entity("IfcAxis2Placement3D",
                                              Location=self.model.create_entity("IfcCartesianPoint",
                                                                                [1000.0 * x for x in least])))
        representation = self.model.create_entity("IfcShapeRepresentation", ContextOfItems=self.body,
                                                  RepresentationIdentifier="Body", RepresentationType="SweptSolid",
                                                  Items=[solid])
        ifcopenshell.api.geometry.assign_representation(self.model, product=element, representation=representation)

    def material(self, name):
        return ifcopenshell.api.material.add_material(self.model, name=name)

    def luminaire(self, name, position, storey, location=None, flux=None):
        """A luminaire at a point [m], in the middle of its body: with a light source of this flux, or the name of a
        photometric file."""
        element = ifcopenshell.api.root.create_entity(self.model, ifc_class="IfcLightFixture", name=name)
        matrix = np.eye(4)
        matrix[:3, 3] = self.origin + position
        ifcopenshell.api.geometry.edit_object_placement(self.model, product=element, matrix=matrix)
        ifcopenshell.api.spatial.assign_container(self.model, products=[element], relating_structure=storey)
        self.add_body(element, (0.2, 0.2, 0.1), (-0.1, -0.1, -0.05))
        if flux is not None:
            place = self.model.create_entity("IfcAxis2Placement3D",
                                             Location=self.model.create_entity("IfcCartesianPoint", (0.0, 0.0, 0.0)))
            curve = self.model.create_entity("IfcLightDistributionData", MainPlaneAngle=0.0, SecondaryPlaneAngle=[0.0, 90.0],
                                             LuminousIntensity=[100.0, 0.0])
            data = self.model.create_entity("IfcLightIntensityDistribution", LightDistributionCurve="TYPE_C",
                                            DistributionData=[curve])
            source = self.model.create_entity(
                "IfcLightSourceGoniometric", LightColour=self.model.create_entity("IfcColourRgb", None, 1.0, 1.0, 1.0),
                Position=place, ColourTemperature=3000.0, LuminousFlux=flux, LightEmissionSource="LIGHTEMITTINGDIODE",
                LightDistributionDataSource=data)
            lights = self.model.create_entity("IfcShapeRepresentation", ContextOfItems=self.body,
                                              RepresentationIdentifier="Lighting", RepresentationType="LightSource",
                                              Items=[source])
            ifcopenshell.api.geometry.assign_representation(self.model, product=element, representation=lights)
        if location is not None:
            pset = ifcopenshell.api.pset.add_pset(self.model, product=element, name="Manufacturer")
            ifcopenshell.api.pset.edit_pset(self.model, pset=pset,
                                            properties={"Photometry": location, "TotalWattage": 24.0})
        return element


def write_building(path: Path, photometry=None, origin=(0.0, 0.0, 0.0), has_shaft=False):
    """Writes the building; the upper luminaire has a photometric file, where one is given, and a shaft is a space,
    too, where there is one."""
    build = Builder(origin)
    concrete, plaster, glass = build.material("Concrete C30"), build.material("Gypsum plaster"), build.material("Glass")
    for number, name in enumerate(("Ground floor", "First floor")):
        storey, z = build.storey(name), number * STOREY
        build.box("IfcSlab", "Slab", (0, 0, z - SLAB), (LENGTH, WIDTH, z), storey, concrete)
        top = z + STOREY - SLAB
        sides = {"south": ((0, 0, z), (LENGTH, WALL, top)), "north": ((0, WIDTH - WALL, z), (LENGTH, WIDTH, top)),
                 "west": ((0, WALL, z), (WALL, WIDTH - WALL, top)),
                 "east": ((LENGTH - WALL, WALL, z), (LENGTH, WIDTH - WALL, top))}
        walls = {side: build.box("IfcWall", f"Wall {side}", *corners, storey, plaster) for side, corners in sides.items()}
        hole = build.box("IfcOpeningElement", "Hole", (2, -0.1, z + 0.9), (4, WALL + 0.1, z + 2.1))
        ifcopenshell.api.feature.add_feature(build.model, feature=hole, element=walls["south"])
        build.box("IfcWindow", "Window", (2, 0.08, z + 0.9), (4, 0.1, z + 2.1), storey, glass)
        space = build.box("IfcSpace", "Room", (WALL, WALL, z), (LENGTH - WALL, WIDTH - WALL, top), storey)
        space.LongName = f"Room {number + 1}"
        build.luminaire(f"Lamp {number + 1}", (LENGTH / 2, WIDTH / 2, top - 0.1), storey,
                        location=photometry if number == 1 else None, flux=2500.0 if number == 0 else None)
    roof = build.storey("Roof")
    build.box("IfcSlab", "Roof slab", (0, 0, 2 * STOREY - SLAB), (LENGTH, WIDTH, 2 * STOREY), roof, concrete)
    if has_shaft:
        build.box("IfcSpace", "Shaft", (1, 1, 0), (1.1, 1.2, STOREY - SLAB), roof)
    build.model.write(str(path))
