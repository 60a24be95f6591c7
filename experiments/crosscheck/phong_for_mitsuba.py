"""Stilb's Phong BRDF for Mitsuba, which has none: diffuse/pi + specular (n+2)/(2 pi) cos+^n(alpha).

Written for this comparison from docs/materials.md: it shares no code with Stilb, nor is it Mitsuba's.
"""

import drjit as dr
import mitsuba as mi


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
        pdf = self.pdf(context, si, wo, active)
        found = active & (pdf > 0)
        sample = dr.zeros(mi.BSDFSample3f)
        sample.wo, sample.pdf, sample.eta = wo, pdf, 1.0
        sample.sampled_type = mi.UInt32(+self.m_components[0])
        sample.sampled_component = mi.UInt32(0)
        return sample, dr.select(found, self.eval(context, si, wo, found) / pdf, 0)

    def traverse(self, callback):
        pass

    def to_string(self):
        return "Phong"
