#include "estimators/tally.h"

namespace stilb::estimators {

void Tally::count(const Batch& batch) {
    samples += batch.count;
    for (std::size_t packet = 0; packet < taken.size(); ++packet)
        taken[packet] += batch.of_packet(packet).count;
}

Tally& Tally::operator+=(const Tally& others) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += others.sum[i];
        largest[i] = std::max(largest[i], others.largest[i]);
        largest_direct[i] = std::max(largest_direct[i], others.largest_direct[i]);
    }
    lacking.resize(std::max(lacking.size(), others.lacking.size()));
    for (std::size_t i = 0; i < others.lacking.size(); ++i) lacking[i] += others.lacking[i];
    for (std::size_t i = 0; i < others.taken.size(); ++i) taken[i] += others.taken[i];
    for (std::size_t i = 0; i < others.parts.size(); ++i) parts[i] += others.parts[i];
    rays += others.rays;
    invalid += others.invalid;
    continued += others.continued;
    comparisons += others.comparisons;
    samples += others.samples;
    return *this;
}

void Tally::write(ByteWriter& bytes) const {
    bytes.add_list(sum);
    bytes.add_list(largest);
    bytes.add_list(largest_direct);
    bytes.add_list(lacking);
    bytes.add_list(taken);
    bytes.add_list(parts);
    for (const std::uint64_t number : {rays, invalid, continued, comparisons, samples}) bytes.add(number);
}

Tally Tally::read(ByteReader& bytes) {
    Tally tally(0);
    tally.sum = bytes.take_list<std::vector<Rgb>>("the sums");
    tally.largest = bytes.take_list<std::vector<double>>("the largest contributions");
    tally.largest_direct = bytes.take_list<std::vector<float>>("the largest direct contributions");
    tally.lacking = bytes.take_list<std::vector<Rgb>>("the comparisons");
    tally.taken = bytes.take_list<std::vector<std::uint64_t>>("the samples of packets");
    tally.parts = bytes.take_list<std::vector<Rgb>>("the channels");
    for (std::uint64_t* number :
         {&tally.rays, &tally.invalid, &tally.continued, &tally.comparisons, &tally.samples})
        *number = bytes.take<std::uint64_t>("the counts");
    const std::size_t readings = tally.sum.size();
    if (tally.largest.size() != readings || tally.largest_direct.size() != readings ||
        (!tally.lacking.empty() && tally.lacking.size() != readings) ||
        (readings > 0 && tally.parts.size() % readings != 0))
        bytes.fail("the sums have different numbers of readings");
    return tally;
}

}  // namespace stilb::estimators
