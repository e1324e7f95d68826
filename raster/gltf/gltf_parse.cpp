// tinygltf behind the C interface of gltf.h: the project's one C++ file.
//
// It parses, and mirrors what was parsed; judging is left to the C files that use the numbers. No
// exception leaves it. Images are kept as the bytes of their files: they are decoded later, on
// all threads, and only those that something shows.
#include "extensions.h"
#include "gltf.h"
#include "load_limits.h"
#include "text.h"

#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace
{

using tinygltf::Value;

struct document : tl_gltf {
    std::string path_text;
    tinygltf::Model model;
    std::vector<tl_gltf_bytes> buffer_list;
    std::vector<tl_gltf_view> view_list;
    std::vector<tl_gltf_accessor> accessor_list;
    std::vector<std::vector<tl_gltf_primitive>> primitive_lists;
    std::vector<std::vector<tl_gltf_target>> target_lists;
    std::vector<std::vector<tl_gltf_influences>> influences_lists;
    std::vector<std::vector<tl_gltf_mapping>> mapping_lists;
    std::vector<std::vector<int>> mapped_lists;
    std::vector<std::string> variant_names;
    std::vector<std::vector<tl_gltf_keys>> keys_lists;
    std::vector<std::vector<tl_gltf_channel>> channel_lists;
    std::vector<tl_gltf_mesh> mesh_list;
    std::vector<tl_gltf_node> node_list;
    std::vector<tl_gltf_scene> scene_list;
    std::vector<tl_gltf_material> material_list;
    std::vector<tl_gltf_texture> texture_list;
    std::vector<tl_gltf_sampler> sampler_list;
    std::vector<tl_gltf_image> image_list;
    std::vector<tl_gltf_camera> camera_list;
    std::vector<tl_gltf_light> light_list;
    std::vector<tl_gltf_skin> skin_list;
    std::vector<tl_gltf_animation> animation_list;
    std::vector<const char *> variant_list, used_list, required_list;
};

const char *const attribute_names[] = {
#define ATTRIBUTE_NAME(name, attribute, least, most) attribute,
    TL_GLTF_ATTRIBUTES(ATTRIBUTE_NAME)
#undef ATTRIBUTE_NAME
};

// --- files that a scene names -----------------------------------------------------------------

struct file_reader {
    std::string folder;
    uint64_t budget = tl_max_buffer_bytes;
    tl_error last_failure = {};
};

// tinygltf tries the working directory after the scene's folder: a scene must not depend on where
// the program was started. Whether the file is there is found out by reading it.
bool is_beside_the_scene(const std::string &path, void *context)
{
    const auto *reader = static_cast<const file_reader *>(context);
    return path.compare(0, reader->folder.size() + 1, reader->folder + "/") == 0;
}

std::string unexpanded(const std::string &path, void *)
{
    return path;
}

bool read_file(std::vector<unsigned char> *out,
               std::string *error,
               const std::string &path,
               void *context)
{
    auto *reader = static_cast<file_reader *>(context);
    uint8_t *data = nullptr;
    size_t size = 0;
    if (tl_file_read(path.substr(0, 1024).c_str(), reader->budget, 0, &data, &size,
                     &reader->last_failure) != TL_OK) {
        *error = reader->last_failure.message;
        return false;
    }
    std::unique_ptr<uint8_t, decltype(&free)> owner(data, free);
    reader->budget -= size;
    out->assign(data, data + size);
    return true;
}

// The bytes of an image in a buffer view may not be touched here: the view is unchecked.
bool keep_image(tinygltf::Image *image,
                const int,
                std::string *,
                std::string *,
                int,
                int,
                const unsigned char *bytes,
                int size,
                void *)
{
    if (image->bufferView < 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

// --- values of extensions ---------------------------------------------------------------------

const Value *find(const tinygltf::ExtensionMap &extensions, const char *name)
{
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double number(const Value *object, const char *name, double otherwise)
{
    if (!object || !object->IsObject() || !object->Has(name))
        return otherwise;
    const Value &value = object->Get(name);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

// An index, or -2, which no index check lets through, where a number is none.
int index_number(const Value *object, const char *name, int otherwise)
{
    const double value = number(object, name, otherwise);
    const bool whole = value >= -1.0 && value <= 1e9 && value == std::floor(value);
    return whole ? static_cast<int>(value) : -2;
}

double number_of_pair(const Value *object, const char *name, int i, double otherwise)
{
    if (!object || !object->IsObject() || !object->Has(name))
        return otherwise;
    const Value &pair = object->Get(name);
    if (!pair.IsArray() || pair.ArrayLen() != 2 || !pair.Get(i).IsNumber())
        return otherwise;
    return pair.Get(i).GetNumberAsDouble();
}

// --- mirroring --------------------------------------------------------------------------------

template <typename Info> tl_gltf_texture_use mirror_use(const Info &info)
{
    const Value *transform = find(info.extensions, "KHR_texture_transform");
    tl_gltf_texture_use use = {};
    use.texture = info.index;
    use.coordinates = index_number(transform, "texCoord", info.texCoord);
    use.rotation = number(transform, "rotation", 0.0);
    for (int i = 0; i < 2; i++) {
        use.offset[i] = number_of_pair(transform, "offset", i, 0.0);
        use.scale[i] = number_of_pair(transform, "scale", i, 1.0);
    }
    return use;
}

tl_gltf_material mirror(const tinygltf::Material &from)
{
    const auto &rough = from.pbrMetallicRoughness;
    const Value *strength = find(from.extensions, "KHR_materials_emissive_strength");
    tl_gltf_material to = {};
    to.name = from.name.c_str();
    to.alpha_mode = from.alphaMode.c_str();
    // tinygltf holds these two to 4 and 3 numbers, or their defaults.
    for (size_t i = 0; i < 4 && i < rough.baseColorFactor.size(); i++)
        to.base_color[i] = rough.baseColorFactor[i];
    for (size_t i = 0; i < 3 && i < from.emissiveFactor.size(); i++)
        to.emissive[i] = from.emissiveFactor[i];
    to.emissive_strength = number(strength, "emissiveStrength", 1.0);
    to.metallic = rough.metallicFactor;
    to.roughness = rough.roughnessFactor;
    to.normal_scale = from.normalTexture.scale;
    to.occlusion_strength = from.occlusionTexture.strength;
    to.alpha_cutoff = from.alphaCutoff;
    to.unlit = find(from.extensions, "KHR_materials_unlit") != nullptr;
    to.double_sided = from.doubleSided;
    to.textures[TL_GLTF_BASE_COLOR] = mirror_use(rough.baseColorTexture);
    to.textures[TL_GLTF_METALLIC_ROUGHNESS] = mirror_use(rough.metallicRoughnessTexture);
    to.textures[TL_GLTF_NORMAL_MAP] = mirror_use(from.normalTexture);
    to.textures[TL_GLTF_OCCLUSION] = mirror_use(from.occlusionTexture);
    to.textures[TL_GLTF_EMISSIVE] = mirror_use(from.emissiveTexture);
    return to;
}

tl_gltf_accessor mirror(const tinygltf::Accessor &from)
{
    tl_gltf_accessor to = {};
    to.view = from.bufferView;
    to.offset = from.byteOffset;
    to.count = from.count;
    to.component_type = from.componentType;
    to.component_count = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(from.type));
    to.normalized = from.normalized;
    to.sparse = from.sparse.isSparse;
    if (to.sparse) {
        to.sparse_count = from.sparse.count;
        to.sparse_index_view = from.sparse.indices.bufferView;
        to.sparse_index_offset = from.sparse.indices.byteOffset;
        to.sparse_index_type = from.sparse.indices.componentType;
        to.sparse_value_view = from.sparse.values.bufferView;
        to.sparse_value_offset = from.sparse.values.byteOffset;
    }
    return to;
}

int attribute(const std::map<std::string, int> &attributes, const std::string &name)
{
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
}

tl_gltf_primitive mirror(const tinygltf::Primitive &from)
{
    tl_gltf_primitive to = {};
    to.mode = from.mode;
    to.indices = from.indices;
    to.material = from.material;
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++)
        to.attributes[i] = attribute(from.attributes, attribute_names[i]);
    return to;
}

tl_gltf_target mirror(const std::map<std::string, int> &from)
{
    tl_gltf_target to = {};
    for (int i = 0; i < TL_GLTF_MORPHED_COUNT; i++)
        to.attributes[i] = attribute(from, attribute_names[i]);
    return to;
}

// Sets are numbered from 0 on; one that is missing between others stays without accessors.
std::vector<tl_gltf_influences> mirror_influences(const std::map<std::string, int> &from)
{
    std::vector<tl_gltf_influences> to;
    for (size_t i = 0; i < from.size(); i++)
        to.push_back({attribute(from, "JOINTS_" + std::to_string(i)),
                      attribute(from, "WEIGHTS_" + std::to_string(i))});
    while (!to.empty() && to.back().joints == -1 && to.back().weights == -1)
        to.pop_back();
    return to;
}

tl_gltf_skin mirror(const tinygltf::Skin &from)
{
    return {from.name.c_str(), from.inverseBindMatrices, from.skeleton, from.joints.size(),
            from.joints.data()};
}

tl_gltf_keys mirror(const tinygltf::AnimationSampler &from)
{
    return {from.input, from.output, from.interpolation.c_str()};
}

tl_gltf_channel mirror(const tinygltf::AnimationChannel &from)
{
    return {from.sampler, from.target_node, from.target_path.c_str()};
}

// A string of an object of extras, which the model holds; "" where there is none.
const char *extras_text(const Value &extras, const char *name)
{
    const Value *found = extras.IsObject() && extras.Has(name) ? &extras.Get(name) : nullptr;
    return found && found->IsString() ? found->Get<std::string>().c_str() : "";
}

void mirror_instancing(const tinygltf::Node &from, tl_gltf_node &to)
{
    const Value *instancing = find(from.extensions, "EXT_mesh_gpu_instancing");
    const Value attributes =
        instancing && instancing->IsObject() && instancing->Has("attributes")
            ? instancing->Get("attributes")
            : Value();
    to.instance_translation = index_number(&attributes, "TRANSLATION", -1);
    to.instance_rotation = index_number(&attributes, "ROTATION", -1);
    to.instance_scale = index_number(&attributes, "SCALE", -1);
}

tl_gltf_node mirror(const tinygltf::Node &from)
{
    const Value *light = find(from.extensions, "KHR_lights_punctual");
    tl_gltf_node to = {};
    to.name = from.name.c_str();
    to.group = extras_text(from.extras, "group");
    to.mesh = from.mesh;
    to.camera = from.camera;
    to.skin = from.skin;
    to.light = index_number(light, "light", -1);
    to.child_count = from.children.size();
    to.children = from.children.data();
    to.matrix_count = from.matrix.size();
    to.matrix = from.matrix.data();
    to.translation_count = from.translation.size();
    to.translation = from.translation.data();
    to.rotation_count = from.rotation.size();
    to.rotation = from.rotation.data();
    to.scale_count = from.scale.size();
    to.scale = from.scale.data();
    to.weight_count = from.weights.size();
    to.weights = from.weights.data();
    mirror_instancing(from, to);
    return to;
}

tl_gltf_camera mirror(const tinygltf::Camera &from)
{
    const bool orthographic = from.type == "orthographic";
    tl_gltf_camera to = {};
    to.name = from.name.c_str();
    to.orthographic = orthographic;
    to.vertical_fov = from.perspective.yfov;
    to.ymag = from.orthographic.ymag;
    to.near = orthographic ? from.orthographic.znear : from.perspective.znear;
    to.far = orthographic ? from.orthographic.zfar : from.perspective.zfar;
    return to;
}

tl_gltf_light mirror(const tinygltf::Light &from)
{
    return {from.name.c_str(),
            from.type.c_str(),
            extras_text(from.extras, "group"),
            from.color.size(),
            from.color.data(),
            from.intensity,
            from.range,
            from.spot.innerConeAngle,
            from.spot.outerConeAngle};
}

tl_gltf_view mirror(const tinygltf::BufferView &from)
{
    return {from.buffer, from.byteOffset, from.byteLength, from.byteStride};
}

tl_gltf_bytes mirror(const tinygltf::Buffer &from)
{
    return {from.data.data(), from.data.size()};
}

tl_gltf_image mirror(const tinygltf::Image &from)
{
    return {from.name.c_str(),
            from.uri.c_str(),
            from.bufferView,
            {from.image.empty() ? nullptr : from.image.data(), from.image.size()}};
}

tl_gltf_texture mirror(const tinygltf::Texture &from)
{
    return {from.sampler, from.source};
}

tl_gltf_sampler mirror(const tinygltf::Sampler &from)
{
    return {from.minFilter, from.magFilter, from.wrapS, from.wrapT};
}

tl_gltf_scene mirror(const tinygltf::Scene &from)
{
    return {from.name.c_str(), from.nodes.size(), from.nodes.data()};
}

const char *mirror(const std::string &from)
{
    return from.c_str();
}

template <typename From, typename To, typename Pointer>
void mirror_all(const std::vector<From> &from,
                std::vector<To> &to,
                Pointer &list,
                size_t &count)
{
    to.reserve(from.size());
    for (const From &one : from)
        to.push_back(mirror(one));
    list = to.data();
    count = to.size();
}

// Lists of lists grow by whole lists, whose elements stay where they are.
void mirror_deformations(document &d, const tinygltf::Primitive &from, tl_gltf_primitive &to)
{
    d.target_lists.emplace_back();
    mirror_all(from.targets, d.target_lists.back(), to.targets, to.target_count);
    d.influences_lists.push_back(mirror_influences(from.attributes));
    to.influences = d.influences_lists.back().data();
    to.influences_count = d.influences_lists.back().size();
}

// The elements of an array of an extension; none where it is no array.
std::vector<Value> elements(const Value *object, const char *name)
{
    std::vector<Value> found;
    if (object && object->IsObject() && object->Has(name))
        for (size_t i = 0; i < object->Get(name).ArrayLen(); i++)
            found.push_back(object->Get(name).Get(static_cast<int>(i)));
    return found;
}

// KHR_materials_variants, of a primitive.
void mirror_mappings(document &d, const tinygltf::Primitive &from, tl_gltf_primitive &to)
{
    std::vector<tl_gltf_mapping> mappings;
    for (const Value &one :
         elements(find(from.extensions, "KHR_materials_variants"), "mappings")) {
        std::vector<int> variants;
        for (const Value &variant : elements(&one, "variants"))
            variants.push_back(variant.IsInt() ? variant.Get<int>() : -2);
        d.mapped_lists.push_back(std::move(variants));
        mappings.push_back({index_number(&one, "material", -1), d.mapped_lists.back().size(),
                            d.mapped_lists.back().data()});
    }
    d.mapping_lists.push_back(std::move(mappings));
    to.mappings = d.mapping_lists.back().data();
    to.mapping_count = d.mapping_lists.back().size();
}

// And of the file.
void mirror_variants(document &d)
{
    for (const Value &one :
         elements(find(d.model.extensions, "KHR_materials_variants"), "variants"))
        d.variant_names.push_back(one.IsObject() && one.Has("name") &&
                                          one.Get("name").IsString()
                                      ? one.Get("name").Get<std::string>()
                                      : "");
    mirror_all(d.variant_names, d.variant_list, d.variants, d.variant_count);
}

void mirror_meshes(document &d)
{
    d.primitive_lists.resize(d.model.meshes.size());
    for (size_t i = 0; i < d.model.meshes.size(); i++) {
        const tinygltf::Mesh &from = d.model.meshes[i];
        tl_gltf_mesh mesh = {};
        mesh.name = from.name.c_str();
        mesh.weight_count = from.weights.size();
        mesh.weights = from.weights.data();
        mirror_all(from.primitives, d.primitive_lists[i], mesh.primitives,
                   mesh.primitive_count);
        for (size_t k = 0; k < mesh.primitive_count; k++) {
            mirror_deformations(d, from.primitives[k], d.primitive_lists[i][k]);
            mirror_mappings(d, from.primitives[k], d.primitive_lists[i][k]);
        }
        d.mesh_list.push_back(mesh);
    }
    d.meshes = d.mesh_list.data();
    d.mesh_count = d.mesh_list.size();
}

void mirror_animations(document &d)
{
    const auto &from = d.model.animations;
    d.keys_lists.resize(from.size());
    d.channel_lists.resize(from.size());
    for (size_t i = 0; i < from.size(); i++) {
        tl_gltf_animation animation = {};
        animation.name = from[i].name.c_str();
        mirror_all(from[i].samplers, d.keys_lists[i], animation.keys, animation.keys_count);
        mirror_all(from[i].channels, d.channel_lists[i], animation.channels,
                   animation.channel_count);
        d.animation_list.push_back(animation);
    }
    d.animations = d.animation_list.data();
    d.animation_count = d.animation_list.size();
}

void mirror_model(document &d)
{
    const tinygltf::Model &m = d.model;
    d.path = d.path_text.c_str();
    d.default_scene = m.defaultScene;
    mirror_all(m.buffers, d.buffer_list, d.buffers, d.buffer_count);
    mirror_all(m.bufferViews, d.view_list, d.views, d.view_count);
    mirror_all(m.accessors, d.accessor_list, d.accessors, d.accessor_count);
    mirror_all(m.nodes, d.node_list, d.nodes, d.node_count);
    mirror_all(m.scenes, d.scene_list, d.scenes, d.scene_count);
    mirror_all(m.materials, d.material_list, d.materials, d.material_count);
    mirror_all(m.textures, d.texture_list, d.textures, d.texture_count);
    mirror_all(m.samplers, d.sampler_list, d.samplers, d.sampler_count);
    mirror_all(m.images, d.image_list, d.images, d.image_count);
    mirror_all(m.cameras, d.camera_list, d.cameras, d.camera_count);
    mirror_all(m.lights, d.light_list, d.lights, d.light_count);
    mirror_all(m.skins, d.skin_list, d.skins, d.skin_count);
    mirror_all(m.extensionsUsed, d.used_list, d.extensions_used, d.used_count);
    mirror_all(m.extensionsRequired, d.required_list, d.extensions_required, d.required_count);
    mirror_variants(d);
    mirror_meshes(d);
    mirror_animations(d);
}

// --- parsing ----------------------------------------------------------------------------------

// tinygltf's messages are lines, sometimes with a whole data URI in them: the first part of them
// as one clause, without the data.
std::string as_clause(std::string text)
{
    const std::string mark = ";base64,";
    const size_t data = text.find(mark);
    if (data != std::string::npos)
        text.replace(data + mark.size(), text.find(' ', data) - data - mark.size(), "...");
    while (!text.empty() && (text.back() == '\n' || text.back() == '.' || text.back() == ' '))
        text.pop_back();
    for (char &c : text)
        if (static_cast<unsigned char>(c) < 0x20)
            c = ' ';
    return text.size() > 300 ? text.substr(0, 300) + " ..." : text;
}

// Errors of tinygltf 2.7 that the specification has not: without inverse bind matrices they are
// identities, and a channel without a node, which it leaves out, belongs to an extension.
void forgive(std::string &error)
{
    static const char *const forgiven[] = {
        "'inverseBindMatrices' property is missing in Skin.\n",
        "'node' property is missing.\n"
        "`node` field is missing in animation.channels.target\n",
    };
    for (const std::string text : forgiven)
        for (size_t at = error.find(text); at != std::string::npos; at = error.find(text))
            error.erase(at, text.size());
}

bool run_parser(document &d,
                const tl_gltf_text &text,
                const uint8_t *data,
                size_t size,
                file_reader &reader,
                std::string &error)
{
    tinygltf::TinyGLTF parser;
    std::string warning; // missing images: found again, and told, by whoever needs them
    parser.SetImageLoader(keep_image, nullptr);
    parser.SetFsCallbacks({is_beside_the_scene, unexpanded, read_file, nullptr, &reader});
    return text.is_binary
               ? parser.LoadBinaryFromMemory(&d.model, &error, &warning, data,
                                             static_cast<unsigned>(size), reader.folder)
               : parser.LoadASCIIFromString(&d.model, &error, &warning, text.json,
                                            static_cast<unsigned>(size), reader.folder);
}

tl_status parse(document &d,
                const tl_gltf_text &text,
                const uint8_t *data,
                size_t size,
                const tl_notices *notices,
                tl_error *err)
{
    const char *const path = d.path_text.c_str();
    const size_t slash = d.path_text.rfind('/');
    file_reader reader;
    std::string error;
    reader.folder = slash == std::string::npos ? "." : d.path_text.substr(0, slash);
    if (slash == 0)
        reader.folder = "/.";

    const bool parsed = run_parser(d, text, data, size, reader, error);
    forgive(error);
    mirror_model(d);
    // First, because what an unknown extension leaves out looks like other faults.
    const tl_status status =
        tl_gltf_check_extensions(path, d.required_count, d.extensions_required, d.used_count,
                                 d.extensions_used, parsed ? notices : nullptr, err);
    if (status != TL_OK)
        return status;
    if (!parsed && reader.last_failure.status != TL_OK &&
        error.find(reader.last_failure.message) != std::string::npos)
        return tl_fail(err, reader.last_failure.status, "%s: names a file that fails: %.1000s",
                       path, reader.last_failure.message);
    // A wrong type leaves an error behind and goes on with a default.
    if (!parsed || !error.empty())
        return tl_fail(err, TL_ERR_FORMAT, "%s: is not valid glTF: %s", path,
                       error.empty() ? "the parser gives no reason" : as_clause(error).c_str());
    const std::string &version = d.model.asset.version, &least = d.model.asset.minVersion;
    if (version.compare(0, 2, "2.") != 0 || (!least.empty() && least != "2.0"))
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: is glTF %s; version 2.0 can be read, so convert it", path,
                       as_clause(least.empty() ? version : least).c_str());
    return TL_OK;
}

} // namespace

extern "C" tl_status tl_gltf_open(const char *path,
                                  const tl_notices *notices,
                                  const tl_gltf **out,
                                  tl_error *err)
{
    uint8_t *data = nullptr;
    size_t size = 0;
    // tinygltf 2.7 lets a binary chunk end up to 8 bytes behind the data; tl_gltf_find_text does
    // not, and the padding covers both.
    tl_status status = tl_file_read(path, tl_max_scene_bytes, 8, &data, &size, err);
    const std::unique_ptr<uint8_t, decltype(&free)> owner(data, free);
    tl_gltf_text text = {};
    if (status == TL_OK)
        status = tl_gltf_find_text(path, data, size, &text, err);
    if (status == TL_OK)
        status = tl_gltf_guard_text(path, &text, err);
    if (status != TL_OK)
        return status;
    try {
        auto made = std::make_unique<document>();
        made->path_text = path;
        status = parse(*made, text, data, size, notices, err);
        if (status == TL_OK)
            *out = made.release();
        return status;
    } catch (const std::bad_alloc &) {
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory while parsing", path);
    } catch (const std::exception &e) {
        return tl_fail(err, TL_ERR_FORMAT, "%s: is not valid glTF: %.300s", path, e.what());
    }
}

extern "C" void tl_gltf_close(const tl_gltf *gltf)
{
    delete static_cast<const document *>(gltf);
}
