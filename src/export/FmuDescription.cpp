// SPDX-License-Identifier: Apache-2.0
#include "FmuVariables.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QUuid>
#include <QtCore/QXmlStreamWriter>

namespace qplc_export {

namespace {

const QString yes = QStringLiteral("true");
const QString no = QStringLiteral("false");

/// Writes the description of a node: in each standard the same facts in other words.
class Description
{
public:
    Description(const ExportedNode &node, Standard standard)
        : m_node(node)
        , m_standard(standard)
        , m_variables(variablesOf(node, standard))
    {
    }
    QByteArray write(const QString &token);

private:
    bool isOld() const { return m_standard == Standard::Fmi2; }
    QString seconds() const { return QString::number(double(m_node.runner().period().count()) * 1e-9, 'g', 15); }
    void writeAbilities();
    void writeUnits();
    void writeTypes();
    void writeVariables();
    void writeVariable(const FmuVariable &variable, int reference);
    void writeValues(const FmuVariable &variable);
    void writeLimit(const QString &name, const QPlcValue &limit, const FmuVariable &variable);
    void writeStructure();
    void writeUnknowns(const QString &list, const QString &element, bool isKnownBefore);
    QString descriptionOf(const FmuVariable &variable) const;
    QString startOf(const FmuVariable &variable) const;
    QString typeName(QPlcSignalIndex index) const;
    QString timeName() const;
    bool isStructured() const;

    const ExportedNode &m_node;
    const Standard m_standard;
    const std::vector<FmuVariable> m_variables;
    QByteArray m_text;
    QXmlStreamWriter m_xml{&m_text};
};

QByteArray Description::write(const QString &token)
{
    m_xml.setAutoFormatting(true);
    m_xml.writeStartDocument();
    m_xml.writeStartElement(QStringLiteral("fmiModelDescription"));
    m_xml.writeAttribute(QStringLiteral("fmiVersion"), isOld() ? QStringLiteral("2.0") : QStringLiteral("3.0"));
    m_xml.writeAttribute(QStringLiteral("modelName"), QLatin1String(identity.name));
    m_xml.writeAttribute(isOld() ? QStringLiteral("guid") : QStringLiteral("instantiationToken"), token);
    if (*identity.description)
        m_xml.writeAttribute(QStringLiteral("description"), QString::fromUtf8(identity.description));
    m_xml.writeAttribute(QStringLiteral("generationTool"), QStringLiteral("QtPLC"));
    m_xml.writeAttribute(QStringLiteral("variableNamingConvention"),
                         isStructured() ? QStringLiteral("structured") : QStringLiteral("flat"));
    writeAbilities();
    writeUnits();
    writeTypes();
    m_xml.writeStartElement(QStringLiteral("LogCategories"));
    QStringList categories{QStringLiteral("logStatusError"), QStringLiteral("logStatusWarning"),
                           QStringLiteral("logStatusDiscard")};
    if (m_node.plant())
        categories << QStringLiteral("logEvents");
    for (const QString &category : qAsConst(categories)) {
        m_xml.writeStartElement(QStringLiteral("Category"));
        m_xml.writeAttribute(QStringLiteral("name"), category);
        m_xml.writeEndElement();
    }
    m_xml.writeEndElement();
    m_xml.writeStartElement(QStringLiteral("DefaultExperiment"));
    m_xml.writeAttribute(QStringLiteral("startTime"), QStringLiteral("0"));
    m_xml.writeAttribute(QStringLiteral("stepSize"), seconds());
    m_xml.writeEndElement();
    writeVariables();
    writeStructure();
    m_xml.writeEndDocument();
    return m_text;
}

void Description::writeAbilities()
{
    m_xml.writeStartElement(QStringLiteral("CoSimulation"));
    m_xml.writeAttribute(QStringLiteral("modelIdentifier"), QLatin1String(identity.name));
    m_xml.writeAttribute(QStringLiteral("canHandleVariableCommunicationStepSize"), yes);
    m_xml.writeAttribute(QStringLiteral("canBeInstantiatedOnlyOncePerProcess"), no);
    if (isOld())
        m_xml.writeAttribute(QStringLiteral("canNotUseMemoryManagementFunctions"), yes);
    else
        m_xml.writeAttribute(QStringLiteral("fixedInternalStepSize"), seconds());
    m_xml.writeEndElement();
}

/// Only real variables have one.
void Description::writeUnits()
{
    QStringList units;
    for (const FmuVariable &variable : m_variables) {
        const QPlcSignalDefinition &signal = m_node.signal(variable.signal);
        if (signal.type.isReal() && !signal.unit.isEmpty() && !units.contains(signal.unit))
            units << signal.unit;
    }
    if (units.isEmpty())
        return;
    m_xml.writeStartElement(QStringLiteral("UnitDefinitions"));
    for (const QString &unit : qAsConst(units)) {
        m_xml.writeStartElement(QStringLiteral("Unit"));
        m_xml.writeAttribute(QStringLiteral("name"), unit);
        m_xml.writeEndElement();
    }
    m_xml.writeEndElement();
}

void Description::writeTypes()
{
    QVector<QPlcSignalIndex> enumerations;
    for (const FmuVariable &variable : m_variables) {
        if (variable.kind == FmuVariable::Enumeration && !enumerations.contains(variable.signal))
            enumerations << variable.signal;
    }
    if (enumerations.isEmpty())
        return;
    m_xml.writeStartElement(QStringLiteral("TypeDefinitions"));
    for (const QPlcSignalIndex index : qAsConst(enumerations)) {
        m_xml.writeStartElement(isOld() ? QStringLiteral("SimpleType") : QStringLiteral("EnumerationType"));
        m_xml.writeAttribute(QStringLiteral("name"), typeName(index));
        if (isOld())
            m_xml.writeStartElement(QStringLiteral("Enumeration"));
        for (const QPlcValueNames::Entry &entry : m_node.signal(index).valueNames) {
            m_xml.writeStartElement(QStringLiteral("Item"));
            m_xml.writeAttribute(QStringLiteral("name"), entry.name);
            m_xml.writeAttribute(QStringLiteral("value"), QString::number(entry.value));
            m_xml.writeEndElement();
        }
        if (isOld())
            m_xml.writeEndElement();
        m_xml.writeEndElement();
    }
    m_xml.writeEndElement();
}

void Description::writeVariables()
{
    m_xml.writeStartElement(QStringLiteral("ModelVariables"));
    if (!isOld()) {
        m_xml.writeStartElement(QStringLiteral("Float64"));
        m_xml.writeAttribute(QStringLiteral("name"), timeName());
        m_xml.writeAttribute(QStringLiteral("valueReference"), QString::number(TimeReference));
        m_xml.writeAttribute(QStringLiteral("causality"), QStringLiteral("independent"));
        m_xml.writeAttribute(QStringLiteral("variability"), QStringLiteral("continuous"));
        m_xml.writeEndElement();
    }
    int reference = 1;
    for (const FmuVariable &variable : m_variables)
        writeVariable(variable, reference++);
    m_xml.writeEndElement();
}

void Description::writeVariable(const FmuVariable &variable, int reference)
{
    m_xml.writeStartElement(isOld() ? QStringLiteral("ScalarVariable") : nameOf(variable.kind));
    m_xml.writeAttribute(QStringLiteral("name"), variable.name);
    m_xml.writeAttribute(QStringLiteral("valueReference"), QString::number(reference));
    const QString description = descriptionOf(variable);
    if (!description.isEmpty())
        m_xml.writeAttribute(QStringLiteral("description"), description);
    m_xml.writeAttribute(QStringLiteral("causality"),
                         variable.isSetting     ? QStringLiteral("parameter")
                             : variable.isInput ? QStringLiteral("input")
                                                : QStringLiteral("output"));
    const bool isReal = m_node.signal(variable.signal).type.isReal();
    m_xml.writeAttribute(QStringLiteral("variability"),
                         variable.isSetting ? QStringLiteral("fixed")
                             : isReal       ? QStringLiteral("continuous")
                                            : QStringLiteral("discrete"));
    if (!variable.isInput)
        m_xml.writeAttribute(QStringLiteral("initial"), QStringLiteral("calculated"));
    if (isOld())
        m_xml.writeStartElement(nameOf(variable.kind));
    writeValues(variable);
    if (isOld())
        m_xml.writeEndElement();
    m_xml.writeEndElement();
}

void Description::writeValues(const FmuVariable &variable)
{
    const QPlcSignalDefinition &signal = m_node.signal(variable.signal);
    const bool isText = variable.kind == FmuVariable::String;
    if (variable.kind == FmuVariable::Enumeration)
        m_xml.writeAttribute(QStringLiteral("declaredType"), typeName(variable.signal));
    if (signal.type.isReal() && !signal.unit.isEmpty())
        m_xml.writeAttribute(QStringLiteral("unit"), signal.unit);
    writeLimit(QStringLiteral("min"), signal.minimum, variable);
    writeLimit(QStringLiteral("max"), signal.maximum, variable);
    if (variable.isInput && (isOld() || !isText))
        m_xml.writeAttribute(QStringLiteral("start"), startOf(variable));
    if (variable.count > 1) {
        m_xml.writeStartElement(QStringLiteral("Dimension"));
        m_xml.writeAttribute(QStringLiteral("start"), QString::number(variable.count));
        m_xml.writeEndElement();
    }
    if (variable.isInput && !isOld() && isText) {
        m_xml.writeStartElement(QStringLiteral("Start"));
        m_xml.writeAttribute(QStringLiteral("value"), startOf(variable));
        m_xml.writeEndElement();
    }
}

void Description::writeLimit(const QString &name, const QPlcValue &limit, const FmuVariable &variable)
{
    if (limit.isValid() && limit.isFinite() && variable.kind != FmuVariable::Boolean
        && variable.kind != FmuVariable::String)
        m_xml.writeAttribute(name, limit.toString());
}

void Description::writeStructure()
{
    m_xml.writeStartElement(QStringLiteral("ModelStructure"));
    if (isOld()) {
        writeUnknowns(QStringLiteral("Outputs"), QStringLiteral("Unknown"), m_node.node().isTwoPhase());
        writeUnknowns(QStringLiteral("InitialUnknowns"), QStringLiteral("Unknown"), true);
    } else {
        writeUnknowns({}, QStringLiteral("Output"), m_node.node().isTwoPhase());
        writeUnknowns({}, QStringLiteral("InitialUnknown"), true);
    }
    m_xml.writeEndElement();
}

/// \param isKnownBefore  they do not depend on inputs of the same time
void Description::writeUnknowns(const QString &list, const QString &element, bool isKnownBefore)
{
    if (m_node.runner().outputs().isEmpty())
        return;
    if (!list.isEmpty())
        m_xml.writeStartElement(list);
    for (std::size_t i = 0; i < m_variables.size(); ++i) {
        if (m_variables[i].isInput)
            continue;
        m_xml.writeStartElement(element);
        m_xml.writeAttribute(isOld() ? QStringLiteral("index") : QStringLiteral("valueReference"),
                             QString::number(i + 1));
        if (isKnownBefore)
            m_xml.writeAttribute(QStringLiteral("dependencies"), QString());
        m_xml.writeEndElement();
    }
    if (!list.isEmpty())
        m_xml.writeEndElement();
}

QString Description::descriptionOf(const FmuVariable &variable) const
{
    const QPlcSignalDefinition &signal = m_node.signal(variable.signal);
    QString text = signal.description;
    if (!signal.unit.isEmpty() && !signal.type.isReal())
        text += QStringLiteral(" [%1]").arg(signal.unit);
    if (signal.type.isDateTime())
        text += QStringLiteral(" [ns since 1970-01-01 UTC]");
    return text.trimmed();
}

QString Description::startOf(const FmuVariable &variable) const
{
    const QPlcValue value = m_node.runner().value(variable.signal);
    if (variable.kind == FmuVariable::String)
        return value.toString();
    QStringList elements;
    for (int element = variable.element; element < variable.element + variable.count; ++element) {
        if (variable.kind == FmuVariable::Boolean)
            elements << (value.toBool(element) ? yes : no);
        else if (value.type().isReal())
            elements << value.toString().split(QStringLiteral(", ")).at(element);
        else if (value.type().scalar() == QPlcSignalType::UInt64)
            elements << QString::number(value.toUInt64(element));
        else
            elements << QString::number(value.toInt64(element));
    }
    return elements.join(QLatin1Char(' '));
}

/// No variable has it.
QString Description::typeName(QPlcSignalIndex index) const
{
    QString name = m_node.signal(index).name + QStringLiteral("_Values");
    while (m_node.runner().table().contains(name))
        name += QLatin1Char('_');
    return name;
}

QString Description::timeName() const
{
    QString name = QStringLiteral("time");
    while (m_node.runner().table().contains(name))
        name += QLatin1Char('_');
    return name;
}

bool Description::isStructured() const
{
    static const QRegularExpression structured(QStringLiteral("^[A-Za-z_]\\w*(\\.[A-Za-z_]\\w*)*$"));
    for (const FmuVariable &variable : m_variables) {
        if (!structured.match(m_node.signal(variable.signal).name).hasMatch())
            return false;
    }
    return true;
}

}  // namespace

QByteArray describe(const ExportedNode &node, Standard standard)
{
    return Description(node, standard).write(tokenOf(node, standard));
}

QString tokenOf(const ExportedNode &node, Standard standard)
{
    static const QUuid space(QStringLiteral("{5d1c0c9e-6a0f-4d53-9c77-0d8f3f6d2b11}"));
    return QUuid::createUuidV5(space, Description(node, standard).write({})).toString();
}

}  // namespace qplc_export
