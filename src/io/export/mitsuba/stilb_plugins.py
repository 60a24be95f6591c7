"""What Mitsuba 3 lacks of Stilb's scenes: Phong's BRDF, rough metal and plastic, and luminaire files.

Import this module after mi.set_variant() and before scene.xml is loaded. The formulas are those of Stilb's documents
materials.md and photometry.md; no code is shared with Stilb.

Rough and plastic: facets (normals and their sampling are Mitsuba's own), and a base (1 - E(in)) (1 - E(out)) / pi,
where E is the albedo of the facets: it keeps the light that facets reflect more than once.
"""

from pathlib import Path

import numpy as np

import drjit as dr
import mitsuba as mi

def _drawn(bsdf, context, si, wo, active):
    """The sample of a BSDF, with its weight, for a direction that was drawn by its density."""
    pdf = bsdf.pdf(context, si, wo, active)
    found = active & (pdf > 0)
    sample = dr.zeros(mi.BSDFSample3f)
    sample.wo, sample.pdf, sample.eta = wo, pdf, 1.0
    sample.sampled_type = mi.UInt32(+bsdf.m_components[0])
    sample.sampled_component = mi.UInt32(0)
    return sample, dr.select(found, bsdf.eval(context, si, wo, found) / pdf, 0)


class Phong(mi.BSDF):
    def __init__(self, properties):
        super().__init__(properties)
        self.diffuse, self.specular = mi.Color3f(properties["diffuse"]), mi.Color3f(properties["specular"])
        self.exponent = properties["exponent"]
        diffuse, specular = mi.luminance(self.diffuse), mi.luminance(self.specular)
        self.lobe_share = specular / dr.maximum(diffuse + specular, 1e-9)
        self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]

    def _lobe_cosine(self, si, wo):
        mirrored = mi.Vector3f(-si.wi.x, -si.wi.y, si.wi.z)
        return dr.maximum(dr.dot(mirrored, wo), 0), mi.Frame3f(mirrored)

    def eval(self, context, si, wo, active=True):
        cosine = self._lobe_cosine(si, wo)[0]
        lobe = (self.exponent + 2) / (2 * dr.pi) * dr.power(cosine, self.exponent)
        value = (self.diffuse / dr.pi + self.specular * lobe) * wo.z
        return value & (active & (si.wi.z > 0) & (wo.z > 0))

    def pdf(self, context, si, wo, active=True):
        cosine, share = self._lobe_cosine(si, wo)[0], self.lobe_share
        lobe = (self.exponent + 1) / (2 * dr.pi) * dr.power(cosine, self.exponent)
        value = share * lobe + (1 - share) * dr.maximum(wo.z, 0) / dr.pi
        return dr.select(active & (si.wi.z > 0) & (wo.z > 0), value, 0)

    def eval_pdf(self, context, si, wo, active=True):
        return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    def sample(self, context, si, sample1, sample2, active=True):
        cosine = dr.power(sample2.x, 1 / (self.exponent + 1))
        sine, angle = dr.safe_sqrt(1 - dr.square(cosine)), 2 * dr.pi * sample2.y
        frame = self._lobe_cosine(si, mi.Vector3f(0, 0, 1))[1]
        glossy = frame.to_world(mi.Vector3f(sine * dr.cos(angle), sine * dr.sin(angle), cosine))
        wo = dr.select(sample1 < self.lobe_share, glossy, mi.warp.square_to_cosine_hemisphere(sample2))
        return _drawn(self, context, si, wo, active)

    def traverse(self, callback):
        pass

    def to_string(self):
        return "Phong"


KNOTS = 192  # of the table of E


class Ggx(mi.BSDF):
    def __init__(self, properties):
        super().__init__(properties)
        self.alpha, self.ior = properties["roughness"], properties["ior"]  # an ior of 0: no Fresnel effect
        self.facets = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)
        color = mi.Color3f(properties["color"])
        # Knots are uniform in the root of the cosine: E changes fastest along the surface.
        cosine = np.linspace(0.002, 1, KNOTS) ** 2
        albedo = np.array([_albedo(self.alpha, self.ior, c) for c in cosine])
        self.table = mi.Float(albedo.astype(np.float32))
        mean = np.trapezoid(2 * cosine * albedo, cosine)
        if self.ior:
            inside = 1 - (1 - mean) / self.ior**2
            self.coat, self.base = mi.Color3f(1), color / (self.ior**2 * (1 - color * inside))
        else:
            self.coat, self.base = color, color**2 * mean / ((1 - color * (1 - mean)) * (1 - mean))
        self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]

    def _reflected(self, cosine):
        """E."""
        place = dr.clip((dr.sqrt(dr.maximum(cosine, 0)) - 0.002) / 0.998, 0, 1) * (KNOTS - 1)
        knot = dr.minimum(mi.UInt32(place), KNOTS - 2)
        low, high = dr.gather(mi.Float, self.table, knot), dr.gather(mi.Float, self.table, knot + 1)
        return dr.lerp(low, high, place - mi.Float(knot))

    def eval(self, context, si, wo, active=True):
        half = dr.normalize(si.wi + wo)
        masking = 1 / (1 + _lambda(self.alpha, si.wi.z) + _lambda(self.alpha, wo.z))
        fresnel = mi.fresnel(dr.dot(si.wi, half), self.ior)[0] if self.ior else 1
        coat = self.coat * (fresnel * self.facets.eval(half) * masking / (4 * si.wi.z))
        base = self.base * ((1 - self._reflected(si.wi.z)) * (1 - self._reflected(wo.z)) * wo.z / dr.pi)
        return (coat + base) & (active & (si.wi.z > 0) & (wo.z > 0))

    def pdf(self, context, si, wo, active=True):
        half = dr.normalize(si.wi + wo)
        facets = self.facets.pdf(si.wi, half) / (4 * dr.dot(wo, half))
        value = dr.lerp(dr.maximum(wo.z, 0) / dr.pi, facets, self._facet_share(si))
        return dr.select(active & (si.wi.z > 0) & (wo.z > 0), value, 0)

    def _facet_share(self, si):
        facets = mi.luminance(self.coat) * self._reflected(si.wi.z)
        return facets / (facets + mi.luminance(self.base) * (1 - self._reflected(si.wi.z)))

    def eval_pdf(self, context, si, wo, active=True):
        return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    def sample(self, context, si, sample1, sample2, active=True):
        facet = mi.reflect(si.wi, self.facets.sample(si.wi, sample2)[0])
        wo = dr.select(sample1 < self._facet_share(si), facet, mi.warp.square_to_cosine_hemisphere(sample2))
        return _drawn(self, context, si, wo, active)

    def traverse(self, callback):
        pass

    def to_string(self):
        return "Ggx"


def _lambda(alpha, cosine):
    return (dr.sqrt(1 + alpha**2 * (1 / dr.square(cosine) - 1)) - 1) / 2


def _albedo(alpha: float, ior: float, cosine: float) -> float:
    """Of the facets alone, over facet normals in proportion to D(h) cos(h)."""
    u, v = (np.arange(400) + 0.5) / 400, (np.arange(45) + 0.5) / 90  # the other half turn is symmetric
    up = np.sqrt((1 - u) / (1 + (alpha**2 - 1) * u))[:, None]
    dot = np.sqrt(1 - up**2) * np.cos(2 * np.pi * v) * np.sqrt(1 - cosine**2) + up * cosine
    out = 2 * dot * up - cosine
    seen = (dot > 0) & (out > 0)
    dot, out = np.where(seen, dot, 1), np.where(seen, out, 1)
    inside = np.sqrt(ior**2 - 1 + dot**2) if ior else 1
    parallel, across = (ior**2 * dot - inside) / (ior**2 * dot + inside), (dot - inside) / (dot + inside)
    fresnel = (parallel**2 + across**2) / 2 if ior else 1
    slopes = (np.sqrt(1 + alpha**2 * (1 / c**2 - 1)) for c in (cosine, out))
    masking = 2 / sum(slopes)
    return float(np.mean(np.where(seen, fresnel * masking * dot / (cosine * up), 0)))


class Luminaire(mi.Emitter):
    """A luminaire that is a point: its intensity is bilinear in C and gamma, by a table in Radiance's format."""

    def __init__(self, properties):
        super().__init__(properties)
        self.position = mi.Point3f(properties["position"])
        axes = (properties[name] for name in ("c0", "c90", "nadir"))
        self.c0, self.c90, self.nadir = (mi.Vector3f(axis) for axis in axes)
        self.factor = mi.Color3f(properties["factor"])
        words = (Path(__file__).parent / properties["filename"]).read_text().split()
        self.planes, self.rings = int(words[3]), int(words[6])
        self.table = mi.Float(np.array(words[7:], dtype=np.float32))
        self.m_flags = +mi.EmitterFlags.DeltaPosition

    def intensity(self, direction):
        """[cd], without the factor; the direction is that of the light."""
        x, y, z = (dr.dot(direction, axis) for axis in (self.c0, self.c90, self.nadir))
        angle = dr.atan2(y, x)
        c = dr.select(angle < 0, angle + 2 * dr.pi, angle) * ((self.planes - 1) / (2 * dr.pi))
        gamma = dr.safe_acos(z) * ((self.rings - 1) / dr.pi)
        plane = dr.clip(mi.UInt32(c), 0, self.planes - 2)
        ring = dr.clip(mi.UInt32(gamma), 0, self.rings - 2)
        at = [dr.gather(mi.Float, self.table, (plane + i) * self.rings + ring + j) for i in (0, 1) for j in (0, 1)]
        along = gamma - mi.Float(ring)
        return dr.lerp(dr.lerp(at[0], at[1], along), dr.lerp(at[2], at[3], along), c - mi.Float(plane))

    def sample_direction(self, it, sample, active=True):
        ds = dr.zeros(mi.DirectionSample3f)
        offset = self.position - it.p
        squared = dr.squared_norm(offset)
        ds.p, ds.dist, ds.d = mi.Point3f(self.position), dr.sqrt(squared), offset * dr.rsqrt(squared)
        ds.time, ds.pdf, ds.delta, ds.emitter = it.time, mi.Float(1), mi.Bool(True), mi.EmitterPtr(self)
        return ds, dr.select(active, self.spectrum(self.intensity(-ds.d) / squared), 0)

    def spectrum(self, value):
        return mi.Spectrum(value * (self.factor if mi.is_rgb else mi.luminance(self.factor)))

    def pdf_direction(self, it, ds, active=True):
        return mi.Float(0)

    def eval_direction(self, it, ds, active=True):
        return dr.select(active, self.spectrum(self.intensity(-ds.d) / dr.square(ds.dist)), 0)

    def eval(self, si, active=True):
        return mi.Spectrum(0)

    def bbox(self):
        return mi.ScalarBoundingBox3f(dr.slice(self.position, 0))

    def traverse(self, callback):
        pass

    def to_string(self):
        return "Luminaire"


mi.register_bsdf("stilb_phong", lambda properties: Phong(properties))
mi.register_bsdf("stilb_ggx", lambda properties: Ggx(properties))
mi.register_emitter("stilb_luminaire", lambda properties: Luminaire(properties))
