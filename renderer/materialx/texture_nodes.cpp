// Pictures: MaterialX specification, "Texture Nodes" and "Helper Nodes"; and USD's own.
#include "renderer/materialx/nodes.h"

namespace hipr {

using namespace gpu;

namespace {

using G = MtlxGeometry;
using Call = MtlxCall;

const GraphValue One(1.f), Zero(0.f);

/// Of MaterialX and of UsdUVTexture.
WrapMode wrapMode(const std::string& text, WrapMode otherwise) {
    if (text == "constant" || text == "black") return WrapMode::Black;
    if (text == "clamp") return WrapMode::Clamp;
    if (text == "periodic" || text == "repeat") return WrapMode::Repeat;
    if (text == "mirror") return WrapMode::Mirror;
    return text == "useMetadata" ? WrapMode::UseMetadata : otherwise;
}

/// Colours without a colour space are taken for what their file suggests, all else for raw numbers.
std::string colorSpace(Call& c, const char* file) {
    for (const std::string& name : {std::string("colorSpace:") + file, std::string("sourceColorSpace")}) {
        const std::string space = c.text(name.c_str());
        if (space == "none" || space == "Raw") return "raw";
        if (!space.empty()) return space;
    }
    return c.type.compare(0, 5, "color") == 0 ? "auto" : "raw";
}

/// What an operation with constants does to texture coordinates: first `inner`, then that.
glm::mat3x2 after(const GraphNode& node, size_t moving, const glm::mat3x2& inner) {
    const glm::vec2 with(node.operands[1 - moving].constant);
    glm::mat2 linear(1.f);
    glm::vec2 offset(0.f);
    if (node.op == GRAPH_ADD) offset = with;
    if (node.op == GRAPH_SUBTRACT) {
        linear = moving == 0 ? glm::mat2(1.f) : glm::mat2(-1.f);
        offset = moving == 0 ? -with : with;
    }
    if (node.op == GRAPH_MULTIPLY) linear = glm::mat2(with.x, 0.f, 0.f, with.y);
    if (node.op == GRAPH_DIVIDE) linear = glm::mat2(1.f / with.x, 0.f, 0.f, 1.f / with.y);
    if (node.op == GRAPH_ROTATE) {
        const float angle = glm::radians(with.x), c = glm::cos(angle), s = glm::sin(angle);
        linear = glm::mat2(c, -s, s, c);
    }
    return {linear * inner[0], linear * inner[1], linear * inner[2] + offset};
}

/// Which operand of a step on the way of texture coordinates is no constant, if a matrix can take its place;
/// else 2.
size_t movingOperand(const GraphNode& node) {
    const bool first = !node.operands[0].isConstant(), second = !node.operands[1].isConstant();
    const glm::vec4 with = node.operands[first ? 1 : 0].constant;
    if (first == second) return 2;
    if (node.op == GRAPH_ADD || node.op == GRAPH_SUBTRACT || node.op == GRAPH_MULTIPLY) return first ? 0 : 1;
    if (node.op == GRAPH_DIVIDE) return first && with.x != 0.f && with.y != 0.f ? 0 : 2;
    const bool around = node.op == GRAPH_ROTATE && node.operands[2] == GraphValue(glm::vec4(0, 0, 1, 0));
    return first && around ? 0 : 2;
}

/// Texture coordinates that are a primvar under a constant transform: of a texture that reads them itself.
bool foldCoordinates(const MaterialGraph& graph, GraphValue st, TextureDesc& texture) {
    std::vector<const GraphNode*> way;
    for (;;) {
        const GraphNode& node = graph.nodes[st.node];
        if (node.op == GRAPH_READ) break;
        const size_t moving = movingOperand(node);
        if (moving > 1) return false;
        way.push_back(&node);
        st = node.operands[moving];
    }
    const MaterialInput& reader = graph.reads[graph.nodes[st.node].immediate];
    if (reader.source != MaterialInput::Source::Primvar) return false;
    texture.uvPrimvar = reader.primvar;
    texture.uvFallback = glm::vec2(reader.constant);
    for (auto node = way.rbegin(); node != way.rend(); ++node)
        texture.uvTransform = after(**node, movingOperand(**node), texture.uvTransform);
    return true;
}

/// The texture at `st`.
GraphValue sample(GraphBuilder& b, MaterialInput input, GraphValue st) {
    if (st.isConstant()) {
        input.texture.uvPrimvar.clear();
        input.texture.uvFallback = glm::vec2(st.constant);
        return b.read(GRAPH_READ, input);
    }
    if (foldCoordinates(b.graph(), st, input.texture)) return b.read(GRAPH_READ, input);
    return b.read(GRAPH_TEXTURE, input, st);
}

bool namesFile(Call& c, const MaterialInput& input) {
    if (input.texture.path.empty()) c.complain("names no file; its fallback is used");
    return !input.texture.path.empty();
}

GraphValue picture(Call& c, const char* file, GraphValue standard, GraphValue st) {
    MaterialInput input;
    input.source = MaterialInput::Source::Texture;
    input.channel = c.components() == 1 ? Channel::R : Channel::Rgb;
    input.texture.path = c.text(file);
    input.texture.colorSpace = colorSpace(c, file);
    input.texture.wrapS = wrapMode(c.text("uaddressmode"), WrapMode::Repeat);
    input.texture.wrapT = wrapMode(c.text("vaddressmode"), WrapMode::Repeat);
    input.texture.fallback = standard.constant;
    if (!namesFile(c, input)) return standard;
    return sample(c.build, input, st);
}

GraphValue image(Call& c) {
    return picture(c, "file", c.in[0], c.in[1]);
}

GraphValue tiledImage(Call& c) {
    GraphBuilder& b = c.build;
    GraphValue st = b.subtract(b.multiply(c.in[1], c.in[2]), c.in[3]);
    st = b.multiply(b.divide(st, c.in[4]), c.in[5]);
    return picture(c, "file", c.in[0], st);
}

/// Three pictures, each along an axis, by how much the normal points that way.
GraphValue triplanar(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue x = b.component(c.in[1], 0), y = b.component(c.in[1], 1), z = b.component(c.in[1], 2);
    const auto pair = [&](GraphValue s, GraphValue t) { return b.op(GRAPH_COMBINE, s, t, Zero); };
    const GraphValue up = c.in[3];
    const auto byAxis = [&](GraphValue xUp, GraphValue yUp, GraphValue zUp) {
        return b.select(b.greater(One, up), xUp, b.select(b.greater(GraphValue(2.f), up), yUp, zUp));
    };
    const GraphValue st[3] = {byAxis(pair(z, y), pair(z, y), pair(y, z)),
                              byAxis(pair(z, x), pair(x, z), pair(x, z)),
                              byAxis(pair(b.subtract(Zero, y), x), pair(x, y), pair(x, y))};
    const char* const files[3] = {"filex", "filey", "filez"};
    const auto share = [&](GraphValue v) { return b.divide(v, b.op(GRAPH_DOT, v, One, {}, 3)); };
    const GraphValue blend = mtlxClamp(b, c.in[4], GraphValue(0.03f), One);
    const GraphValue flat = share(b.op(GRAPH_ABS, c.in[2]));
    const GraphValue weights = share(b.op(GRAPH_POWER, flat, b.divide(One, blend)));
    GraphValue sum = Zero;
    for (uint32_t i = 0; i < 3; ++i)
        sum = b.add(sum, b.multiply(picture(c, files[i], c.in[0], st[i]), b.component(weights, i)));
    return sum;
}

GraphValue place2d(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue pivot = c.in[1], scale = c.in[2], turn = c.in[3], offset = c.in[4];
    const GraphValue axis(glm::vec4(0, 0, 1, 0)), off = b.subtract(c.in[0], pivot);
    const auto turned = [&](GraphValue v) {
        const bool still = turn.isConstant() && turn.constant.x == 0.f;
        return still ? v : b.op(GRAPH_ROTATE, v, turn, axis);
    };
    const GraphValue first = b.add(b.subtract(turned(b.divide(off, scale)), offset), pivot);
    const GraphValue second = b.add(b.divide(turned(b.subtract(off, offset)), scale), pivot);
    return b.select(b.greater(One, c.in[5]), first, second);
}

/// in, rotation, scale, translation: turned counter-clockwise.
GraphValue usdTransform(Call& c) {
    GraphBuilder& b = c.build;
    const GraphValue axis(glm::vec4(0, 0, 1, 0));
    const GraphValue turned =
        b.op(GRAPH_ROTATE, b.multiply(c.in[0], c.in[2]), b.subtract(Zero, c.in[1]), axis);
    return b.add(turned, c.in[3]);
}

/// fallback, st, scale, bias; the output names the channel.
GraphValue usdTexture(Call& c) {
    MaterialInput input;
    input.source = MaterialInput::Source::Texture;
    input.texture.path = c.text("file");
    const std::string space = c.text("sourceColorSpace"), other = c.text("colorSpace:file");
    input.texture.colorSpace = !space.empty() ? space : (other.empty() ? "auto" : other);
    const WrapMode wrap = c.usd ? WrapMode::UseMetadata : WrapMode::Repeat;
    input.texture.wrapS = wrapMode(c.text("wrapS"), wrap);
    input.texture.wrapT = wrapMode(c.text("wrapT"), wrap);
    input.texture.fallback = c.in[0].constant;
    input.texture.scale = c.in[2].isConstant() ? c.in[2].constant : glm::vec4(1.f);
    input.texture.bias = c.in[3].isConstant() ? c.in[3].constant : glm::vec4(0.f);
    const std::string channels = "rgba";
    const size_t channel = c.output.size() == 1 ? channels.find(c.output) : std::string::npos;
    input.channel = channel == std::string::npos ? Channel::Rgb : Channel(channel);
    if (!namesFile(c, input))
        return channel == std::string::npos ? c.in[0] : c.build.component(c.in[0], uint32_t(channel));
    return sample(c.build, input, c.usd && !c.given[1] ? Zero : c.in[1]);
}

} // namespace

std::vector<MtlxNode> mtlxTextureNodes() {
    const char* const texture = "texture";
    const MtlxInput st{"texcoord", G::Uv}, scale{"scale", 1.f};
    return {
        {"image", texture, {"default", st}, image},
        {"tiledimage",
         texture,
         {"default",
          st,
          {"uvtiling", 1.f},
          "uvoffset",
          {"realworldimagesize", 1.f},
          {"realworldtilesize", 1.f}},
         tiledImage},
        {"triplanarprojection",
         texture,
         {"default",
          {"position", G::PositionObject},
          {"normal", G::NormalObject},
          {"upaxis", 2.f},
          {"blend", 1.f}},
         triplanar},
        {"place2d", texture, {st, "pivot", scale, "rotate", "offset", "operationorder"}, place2d},
        {"UsdUVTexture",
         texture,
         {{"fallback", glm::vec4(0, 0, 0, 1)}, {"st", G::Uv}, scale, "bias"},
         usdTexture},
        {"UsdTransform2d", texture, {"in", "rotation", scale, "translation"}, usdTransform},
    };
}

} // namespace hipr
