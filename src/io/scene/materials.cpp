// [materials.NAME]
#include "io/scene/fields.h"
#include "io/scene/sections.h"

namespace stilb::io {
namespace {

/// Each model reads its own parameters.
Material read_material(TomlTable& table) {
    const std::string_view type = table.choose("type", materials::type_names());
    std::optional<Material> read;
    materials::for_each_model([&]<typename Model>() {
        if (type == Model::kType)
            read = Model(read_typed_fields<materials::ParametersOf<Model>>(table, Model::kType));
    });
    return *read;
}

}  // namespace

std::vector<NamedMaterial> read_materials(const TomlTable& section) {
    std::vector<NamedMaterial> materials;
    for (auto& [name, table] : named_tables(section)) {
        materials.push_back({name, read_material(table)});
    }
    return materials;
}

}  // namespace stilb::io
