#include "transport/lobe_choice.h"

namespace stilb::transport {

std::optional<LobeChoice> choose_lobe(const Material& material, rays::Hit& hit, Vec3& from,
                                      materials::Carried carried, math::SampleStream& stream) {
    const std::span<const materials::Lobe> lobes = lobes_at(hit, material, carried);
    if (lobes.empty()) return LobeChoice{&material, nullptr, 1, reflectance_bound(material)};
    const double cosine = dot(from, hit.normal);
    LobeChoice chosen;
    double own = 0, before = 0;
    for (const materials::Lobe& lobe : lobes) chosen.sent_on += materials::sent_on(lobe.scattering, cosine);
    const double all = chosen.sent_on.luminance(), u = stream.next() * all;
    for (const materials::Lobe& lobe : lobes) {
        const double luminance = materials::sent_on(lobe.scattering, cosine).luminance();
        if (!(luminance > 0)) continue;
        chosen.lobe = &lobe, own = luminance;
        before += luminance;
        if (u < before) break;
    }
    if (!chosen.lobe) return std::nullopt;
    cross(*chosen.lobe, hit, from);
    chosen.material = &chosen.lobe->scattering;
    chosen.weight = chosen.lobe->factor(carried) * all / own;
    return chosen;
}

}  // namespace stilb::transport
