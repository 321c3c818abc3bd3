// SPDX-License-Identifier: Apache-2.0
#include "SceneNodes.h"

#include <Qt3DRender/QBlendEquation>
#include <Qt3DRender/QBlendEquationArguments>
#include <Qt3DRender/QCullFace>
#include <Qt3DRender/QDepthTest>
#include <Qt3DRender/QEffect>
#include <Qt3DRender/QFilterKey>
#include <Qt3DRender/QGeometry>
#include <Qt3DRender/QGraphicsApiFilter>
#include <Qt3DRender/QNoDepthMask>
#include <Qt3DRender/QRenderPass>
#include <Qt3DRender/QShaderProgram>
#include <Qt3DRender/QTechnique>

namespace qplc {

using namespace Qt3DRender;

namespace {

struct Dialect
{
    QGraphicsApiFilter::Api api;
    QGraphicsApiFilter::OpenGLProfile profile;
    int major;
    int minor;
    const char *vertexHead;
    const char *fragmentHead;
};

// The shaders are written in words that these lines give a meaning in each dialect of the language.
const Dialect dialects[] = {
    {QGraphicsApiFilter::OpenGL, QGraphicsApiFilter::CoreProfile, 3, 2,
     "#version 150\n#define IN in\n#define OUT out\n",
     "#version 150\n#define IN in\nout vec4 pixel;\n#define PIXEL pixel\n"},
    {QGraphicsApiFilter::OpenGL, QGraphicsApiFilter::NoProfile, 2, 0,
     "#version 120\n#define IN attribute\n#define OUT varying\n",
     "#version 120\n#define IN varying\n#define PIXEL gl_FragColor\n"},
    {QGraphicsApiFilter::OpenGLES, QGraphicsApiFilter::NoProfile, 2, 0,
     "#version 100\n#define IN attribute\n#define OUT varying\n",
     "#version 100\nprecision highp float;\n#define IN varying\n#define PIXEL gl_FragColor\n"},
};

const char solidVertex[] = R"(
IN vec3 vertexPosition;
IN vec3 vertexNormal;
IN vec3 vertexColor;
OUT vec3 normal;
OUT vec3 color;
OUT vec3 toEye;
uniform mat4 modelViewProjection;
uniform mat4 modelView;
uniform mat3 modelViewNormal;
void main()
{
    normal = modelViewNormal * vertexNormal;
    color = vertexColor;
    toEye = -vec3(modelView * vec4(vertexPosition, 1.0));
    gl_Position = modelViewProjection * vec4(vertexPosition, 1.0);
}
)";

// Both sides of a thin skin are lit, by a lamp above the left shoulder of whoever looks; the edge
// is a little darker.
const char solidFragment[] = R"(
IN vec3 normal;
IN vec3 color;
IN vec3 toEye;
void main()
{
    vec3 n = normalize(normal);
    vec3 eye = normalize(toEye);
    if (dot(n, eye) < 0.0)
        n = -n;
    float lamp = max(dot(n, normalize(vec3(-0.35, 0.75, 0.65))), 0.0);
    float edge = 0.8 + 0.2 * dot(n, eye);
    PIXEL = vec4(color * edge * (0.5 + 0.55 * lamp), 1.0);
}
)";

// A line becomes a strip of width + 1 pixels across its direction on the screen; ends behind the
// eye are moved to the front.
const char lineVertex[] = R"(
IN vec3 vertexPosition;
IN vec3 otherEnd;
IN vec4 vertexColor;
IN vec3 lineSide;
OUT vec4 color;
OUT vec3 across;
uniform mat4 modelViewProjection;
uniform vec3 viewport;
const float nearest = 0.001;
vec4 inFront(vec4 a, vec4 b)
{
    if (a.w >= nearest || b.w <= nearest)
        return a;
    return mix(a, b, (nearest - a.w) / (b.w - a.w));
}
void main()
{
    vec4 here = modelViewProjection * vec4(vertexPosition, 1.0);
    vec4 there = modelViewProjection * vec4(otherEnd, 1.0);
    vec4 a = inFront(here, there);
    vec4 b = inFront(there, here);
    vec2 way = (b.xy / b.w - a.xy / a.w) * viewport.xy * lineSide.y;
    float len = length(way);
    vec2 normal = len > 0.0001 ? vec2(-way.y, way.x) / len : vec2(0.0, 1.0);
    float half_ = 0.5 * lineSide.z * viewport.z + 0.75;
    a.xy += normal * lineSide.x * half_ * 2.0 / viewport.xy * a.w;
    color = vertexColor;
    across = vec3(lineSide.x * half_ * a.w, a.w, half_ - 0.5);
    gl_Position = a;
}
)";

const char lineFragment[] = R"(
IN vec4 color;
IN vec3 across;
void main()
{
    float coverage = clamp(across.z + 0.25 - abs(across.x / across.y), 0.0, 1.0);
    PIXEL = vec4(color.rgb, color.a * coverage);
}
)";

void addKey(QRenderPass *pass, SceneMaterial::Kind kind)
{
    auto *key = new QFilterKey(pass);
    key->setName(QStringLiteral("pass"));
    key->setValue(kind == SceneMaterial::Solid ? QStringLiteral("solid") : QStringLiteral("lines"));
    pass->addFilterKey(key);
}

void addStates(QRenderPass *pass, SceneMaterial::Kind kind)
{
    auto *depth = new QDepthTest(pass);
    depth->setDepthFunction(QDepthTest::LessOrEqual);
    pass->addRenderState(depth);
    auto *cull = new QCullFace(pass);
    cull->setMode(QCullFace::NoCulling);
    pass->addRenderState(cull);
    if (kind == SceneMaterial::Solid)
        return;
    pass->addRenderState(new QNoDepthMask(pass));
    auto *factors = new QBlendEquationArguments(pass);
    factors->setSourceRgb(QBlendEquationArguments::SourceAlpha);
    factors->setDestinationRgb(QBlendEquationArguments::OneMinusSourceAlpha);
    factors->setSourceAlpha(QBlendEquationArguments::Zero);
    factors->setDestinationAlpha(QBlendEquationArguments::One);
    pass->addRenderState(factors);
    auto *equation = new QBlendEquation(pass);
    equation->setBlendFunction(QBlendEquation::Add);
    pass->addRenderState(equation);
}

QTechnique *makeTechnique(const Dialect &dialect, SceneMaterial::Kind kind, Qt3DCore::QNode *parent)
{
    auto *technique = new QTechnique(parent);
    technique->graphicsApiFilter()->setApi(dialect.api);
    technique->graphicsApiFilter()->setProfile(dialect.profile);
    technique->graphicsApiFilter()->setMajorVersion(dialect.major);
    technique->graphicsApiFilter()->setMinorVersion(dialect.minor);
    auto *program = new QShaderProgram(technique);
    const bool isSolid = kind == SceneMaterial::Solid;
    program->setVertexShaderCode(QByteArray(dialect.vertexHead) + (isSolid ? solidVertex : lineVertex));
    program->setFragmentShaderCode(QByteArray(dialect.fragmentHead) + (isSolid ? solidFragment : lineFragment));
    auto *pass = new QRenderPass(technique);
    pass->setShaderProgram(program);
    addKey(pass, kind);
    addStates(pass, kind);
    technique->addRenderPass(pass);
    return technique;
}

}  // namespace

SceneMaterial::SceneMaterial(Kind kind, Qt3DCore::QNode *parent)
    : QMaterial(parent)
{
    auto *effect = new QEffect(this);
    for (const Dialect &dialect : dialects)
        effect->addTechnique(makeTechnique(dialect, kind, effect));
    setEffect(effect);
    if (kind == Lines) {
        m_viewport = new QParameter(QStringLiteral("viewport"), QVector3D(640, 480, 1), this);
        addParameter(m_viewport);
    }
}

void SceneMaterial::setViewport(const QSize &size, double pixelRatio)
{
    if (m_viewport)
        m_viewport->setValue(QVector3D(float(size.width()), float(size.height()), float(pixelRatio)));
}

BufferEntity::BufferEntity(SceneMaterial *material, Qt3DCore::QNode *parent)
    : QEntity(parent)
    , m_renderer(new QGeometryRenderer(this))
{
    m_geometry = new QGeometry(m_renderer);
    m_vertexData = new Qt3DRender::QBuffer(m_geometry);
    m_renderer->setGeometry(m_geometry);
    m_renderer->setPrimitiveType(QGeometryRenderer::Triangles);
    m_renderer->setVertexCount(0);
    addComponent(m_renderer);
    addComponent(material);
    setEnabled(false);
}

void BufferEntity::addAttribute(const char *name, uint size, uint offset, uint stride)
{
    auto *attribute = new QAttribute(m_vertexData, QString::fromLatin1(name), QAttribute::Float, size, 0,
                                     offset * sizeof(float), stride, m_geometry);
    m_geometry->addAttribute(attribute);
    m_attributes.append(attribute);
}

void BufferEntity::addIndices()
{
    m_indexData = new Qt3DRender::QBuffer(m_geometry);
    m_indices = new QAttribute(m_indexData, QAttribute::UnsignedInt, 1, 0, 0, 0, m_geometry);
    m_indices->setAttributeType(QAttribute::IndexAttribute);
    m_geometry->addAttribute(m_indices);
}

LineEntity::LineEntity(SceneMaterial *material, Qt3DCore::QNode *parent)
    : BufferEntity(material, parent)
{
    constexpr uint stride = sizeof(LineBatch::Vertex);
    m_vertexData->setUsage(Qt3DRender::QBuffer::DynamicDraw);
    addAttribute("vertexPosition", 3, 0, stride);
    addAttribute("otherEnd", 3, 3, stride);
    addAttribute("vertexColor", 4, 6, stride);
    addAttribute("lineSide", 3, 10, stride);
    addIndices();
}

void LineEntity::setLines(const LineBatch &lines)
{
    if (lines.lines() > m_indexedLines) {
        m_indexedLines = 2 * lines.lines();
        m_indexData->setData(LineBatch::indexBytes(m_indexedLines));
    }
    m_vertexData->setData(lines.vertexBytes());
    for (QAttribute *attribute : qAsConst(m_attributes))
        attribute->setCount(uint(4 * lines.lines()));
    m_indices->setCount(uint(6 * lines.lines()));
    m_renderer->setVertexCount(6 * lines.lines());
    setEnabled(lines.lines() > 0);
}

MeshEntity::MeshEntity(SceneMaterial *material, Qt3DCore::QNode *parent)
    : BufferEntity(material, parent)
    , m_transform(new Qt3DCore::QTransform(this))
{
    constexpr uint stride = sizeof(ObjMesh::Vertex);
    static_assert(stride == 9 * sizeof(float), "a vertex is nine numbers");
    addAttribute("vertexPosition", 3, 0, stride);
    addAttribute("vertexNormal", 3, 3, stride);
    addAttribute("vertexColor", 3, 6, stride);
    addComponent(m_transform);
}

void MeshEntity::setMesh(const ObjMesh &mesh)
{
    const auto *bytes = reinterpret_cast<const char *>(mesh.triangles.data());
    m_vertexData->setData(QByteArray(bytes, int(mesh.triangles.size() * sizeof(ObjMesh::Vertex))));
    for (QAttribute *attribute : qAsConst(m_attributes))
        attribute->setCount(uint(mesh.triangles.size()));
    m_renderer->setVertexCount(int(mesh.triangles.size()));
    setEnabled(!mesh.triangles.empty());
}

}  // namespace qplc
