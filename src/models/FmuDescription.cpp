// SPDX-License-Identifier: Apache-2.0
#include "FmuDescription.h"

#include "signals/MessageText.h"

#include <QtCore/QXmlStreamReader>

#include <algorithm>
#include <cmath>
#include <utility>

namespace qplc {

namespace {

struct KindName
{
    const char *name;
    FmuVariable::Kind kind;
};
constexpr KindName kindsOf3[] = {
    {"Float32", FmuVariable::Float32}, {"Float64", FmuVariable::Float64}, {"Int8", FmuVariable::Int8},
    {"UInt8", FmuVariable::UInt8},     {"Int16", FmuVariable::Int16},     {"UInt16", FmuVariable::UInt16},
    {"Int32", FmuVariable::Int32},     {"UInt32", FmuVariable::UInt32},   {"Int64", FmuVariable::Int64},
    {"UInt64", FmuVariable::UInt64},   {"Boolean", FmuVariable::Boolean}, {"String", FmuVariable::String},
    {"Binary", FmuVariable::Binary},   {"Clock", FmuVariable::Clock},     {"Enumeration", FmuVariable::Int64},
};
constexpr KindName kindsOf2[] = {
    {"Real", FmuVariable::Float64},  {"Integer", FmuVariable::Int32},     {"Boolean", FmuVariable::Boolean},
    {"String", FmuVariable::String}, {"Enumeration", FmuVariable::Int32},
};
constexpr const char *causalityNames[]
    = {"local", "input", "output", "parameter", "calculatedParameter", "structuralParameter", "independent"};
constexpr const char *variabilityNames[] = {"constant", "fixed", "tunable", "discrete", "continuous"};

template<std::size_t N>
int indexOf(const char *const (&names)[N], const QString &name)
{
    for (std::size_t i = 0; i < N; ++i) {
        if (name == QLatin1String(names[i]))
            return int(i);
    }
    return -1;
}

const KindName *kindOf(int version, const QStringRef &element)
{
    const auto find = [&](const KindName *begin, const KindName *end) {
        const KindName *found
            = std::find_if(begin, end, [&](const KindName &kind) { return element == QLatin1String(kind.name); });
        return found == end ? nullptr : found;
    };
    return version == 2 ? find(std::begin(kindsOf2), std::end(kindsOf2))
                        : find(std::begin(kindsOf3), std::end(kindsOf3));
}

/// The reader of Qt compares each attribute of an element with all others: without a limit, a file
/// of a few megabytes takes hours. \return the line of an element with too many, 0: there is none
int lineWithTooManyAttributes(const QByteArray &text)
{
    int line = 1;
    int attributes = 0;
    bool isInside = false;
    char quote = 0;
    for (int i = 0; i < text.size(); ++i) {
        const char character = text.at(i);
        line += character == '\n' ? 1 : 0;
        if (quote != 0) {
            quote = character == quote ? char(0) : quote;
        } else if (isInside) {
            isInside = character != '>';
            quote = character == '"' || character == '\'' ? character : char(0);
            attributes += character == '=' ? 1 : 0;
            if (attributes > FmuDescription::MostAttributes)
                return line;
        } else if (character == '<') {
            const bool isComment = qstrncmp(text.constData() + i, "<!--", 4) == 0;
            const bool isData = qstrncmp(text.constData() + i, "<![CDATA[", 9) == 0;
            if (isComment || isData) {
                const int end = text.indexOf(isComment ? "-->" : "]]>", i);
                const int next = end < 0 ? text.size() : end + 2;
                line += int(std::count(text.constData() + i, text.constData() + next, '\n'));
                i = next;
            } else {
                isInside = true;
                attributes = 0;
            }
        }
    }
    return 0;
}

}  // namespace

// ---- variables ----

QPlcSignalType::Scalar FmuVariable::scalar(int version) const
{
    constexpr QPlcSignalType::Scalar scalars[KindCount]
        = {QPlcSignalType::Real32,  QPlcSignalType::Real64, QPlcSignalType::Int8,  QPlcSignalType::UInt8,
           QPlcSignalType::Int16,   QPlcSignalType::UInt16, QPlcSignalType::Int32, QPlcSignalType::UInt32,
           QPlcSignalType::Int64,   QPlcSignalType::UInt64, QPlcSignalType::UInt8, QPlcSignalType::Invalid,
           QPlcSignalType::Invalid, QPlcSignalType::Invalid};
    return kind == Boolean && version == 2 ? QPlcSignalType::Int32 : scalars[kind];
}

bool FmuVariable::hasStart() const
{
    return variability != Constant && causality != StructuralParameter
        && (causality == Parameter || causality == Input || initial == QLatin1String("exact")
            || initial == QLatin1String("approx"));
}

QString FmuVariable::typeText(int version) const
{
    QString text = QStringLiteral("Enumeration");
    if (!isEnumeration) {
        const auto isSame = [this](const KindName &row) { return row.kind == kind; };
        text = QString::fromLatin1(version == 2 ? std::find_if(std::begin(kindsOf2), std::end(kindsOf2), isSame)->name
                                                : std::find_if(std::begin(kindsOf3), std::end(kindsOf3), isSame)->name);
    }
    for (int size : dimensions)
        text += QStringLiteral("[%1]").arg(size);
    return text;
}

QString FmuVariable::causalityText() const
{
    return QString::fromLatin1(causalityNames[causality]);
}

// ---- the file ----

/// Reads a modelDescription.xml, element by element.
class FmuDescriptionReader
{
public:
    explicit FmuDescriptionReader(const QByteArray &text)
        : m_text(text)
        , m_xml(text)
    {
    }

    FmuDescription read(QPlcParseError *error);

private:
    struct TypeDefinition
    {
        QString unit;
        QString minimum;
        QString maximum;
        QVector<QPair<qint64, QString>> items;
    };
    struct Alias
    {
        int variable = -1;
        QString name;
        QString description;
    };
    struct Dimension
    {
        int variable = -1;
        int size = 0;
        std::optional<quint32> reference;  // of a structural parameter
        int line = 0;
    };

    void readToken();
    void beginElement();
    void readRoot();
    void readCoSimulation();
    void readExperiment();
    void readTypePart();
    void readVariablePart();
    void beginVariable(const KindName &kind);
    void readAttributes(FmuVariable *variable);
    void readDimension();
    void addAlias();
    void finish();
    void finishDimensions();
    void finishVariables();
    bool readNumber(const char *name, std::optional<double> *number);
    bool isTrue(const char *name) const;
    QString attribute(const char *name) const;
    void fail(const QString &message) { fail(int(m_xml.lineNumber()), int(m_xml.columnNumber()) + 1, message); }
    void fail(int line, int column, const QString &message)
    {
        if (m_error.message.isEmpty())
            m_error = {QStringLiteral("modelDescription.xml"), line, column, message};
    }
    bool hasFailed() const { return !m_error.message.isEmpty(); }

    const QByteArray &m_text;
    QXmlStreamReader m_xml;
    QXmlStreamAttributes m_attributes;
    FmuDescription m_description;
    QPlcParseError m_error;
    int m_depth = 0;
    QString m_part;  // element below the root
    bool m_hasVariable = false;
    QString m_typeName;
    QHash<QString, TypeDefinition> m_types;
    QVector<Dimension> m_dimensions;
    QVector<Alias> m_aliases;
};

FmuDescription FmuDescription::fromXml(const QByteArray &text, QPlcParseError *error)
{
    return FmuDescriptionReader(text).read(error);
}

FmuDescription FmuDescriptionReader::read(QPlcParseError *error)
{
    if (m_text.size() > FmuDescription::LargestText)
        fail(0, 0,
             QStringLiteral("the file has %1 MiB, more than %2")
                 .arg(m_text.size() >> 20)
                 .arg(FmuDescription::LargestText >> 20));
    else if (const int line = lineWithTooManyAttributes(m_text))
        fail(line, 0, QStringLiteral("an element has more than %1 attributes").arg(FmuDescription::MostAttributes));
    while (!hasFailed() && !m_xml.atEnd())
        readToken();
    if (!hasFailed() && m_xml.hasError())
        fail(QStringLiteral("this is not XML: %1").arg(m_xml.errorString()));
    if (!hasFailed() && !m_description.isValid())
        fail(0, 0, QStringLiteral("there is no element fmiModelDescription; this is not the description of an FMU"));
    if (!hasFailed())
        finish();
    *error = m_error;
    return hasFailed() ? FmuDescription() : std::move(m_description);
}

void FmuDescriptionReader::readToken()
{
    switch (m_xml.readNext()) {
    case QXmlStreamReader::DTD:
    case QXmlStreamReader::EntityReference:
        fail(QStringLiteral("the file declares or uses entities, which no FMU needs; remove the DOCTYPE"));
        break;
    case QXmlStreamReader::StartElement:
        if (++m_depth > FmuDescription::LargestDepth)
            fail(QStringLiteral("more than %1 elements stand inside of each other").arg(FmuDescription::LargestDepth));
        else
            beginElement();
        break;
    case QXmlStreamReader::EndElement:
        --m_depth;
        break;
    default:
        break;
    }
}

void FmuDescriptionReader::beginElement()
{
    m_attributes = m_xml.attributes();
    if (m_depth == 1) {
        readRoot();
    } else if (m_depth == 2) {
        m_part = m_xml.name().toString();
        if (m_part == QLatin1String("CoSimulation"))
            readCoSimulation();
        else if (m_part == QLatin1String("ModelExchange"))
            m_description.otherKinds << QStringLiteral("model exchange");
        else if (m_part == QLatin1String("ScheduledExecution"))
            m_description.otherKinds << QStringLiteral("scheduled execution");
        else if (m_part == QLatin1String("DefaultExperiment"))
            readExperiment();
    } else if (m_part == QLatin1String("TypeDefinitions")) {
        readTypePart();
    } else if (m_part == QLatin1String("ModelVariables")) {
        readVariablePart();
    }
}

void FmuDescriptionReader::readRoot()
{
    if (m_xml.name() != QLatin1String("fmiModelDescription")) {
        fail(QStringLiteral("the file begins with %1 instead of fmiModelDescription; this is not the description of an "
                            "FMU")
                 .arg(quoted(m_xml.name().toString())));
        return;
    }
    m_description.versionText = attribute("fmiVersion");
    const bool isPreview = m_description.versionText.contains(QLatin1Char('-'));
    if (m_description.versionText.startsWith(QLatin1String("2.")) && !isPreview)
        m_description.version = 2;
    else if (m_description.versionText.startsWith(QLatin1String("3.")) && !isPreview)
        m_description.version = 3;
    else
        fail(QStringLiteral("the FMU follows version %1 of FMI; QtPLC offers 2.0 and 3.0: export it again as one of "
                            "these")
                 .arg(quoted(m_description.versionText)));
    m_description.modelName = attribute("modelName");
    m_description.token = attribute(m_description.version == 2 ? "guid" : "instantiationToken");
    m_description.generationTool = attribute("generationTool");
    m_description.description = attribute("description");
}

void FmuDescriptionReader::readCoSimulation()
{
    m_description.hasCoSimulation = true;
    m_description.modelIdentifier = attribute("modelIdentifier");
    m_description.needsExecutionTool = isTrue("needsExecutionTool");
    m_description.handlesVariableStep = isTrue("canHandleVariableCommunicationStepSize");
    m_description.onlyOneInstance = isTrue("canBeInstantiatedOnlyOncePerProcess");
    m_description.hasEventMode = m_description.version == 3 && isTrue("hasEventMode");
    readNumber("fixedInternalStepSize", &m_description.fixedInternalStep);
    const QString &identifier = m_description.modelIdentifier;
    if (identifier.isEmpty() || identifier.contains(QLatin1Char('/')) || identifier.startsWith(QLatin1Char('.')))
        fail(QStringLiteral("modelIdentifier %1 is not the name of a library").arg(quoted(identifier)));
}

void FmuDescriptionReader::readExperiment()
{
    readNumber("startTime", &m_description.startTime);
    readNumber("stopTime", &m_description.stopTime);
    readNumber("tolerance", &m_description.tolerance);
    readNumber("stepSize", &m_description.stepSize);
}

// ---- types ----

void FmuDescriptionReader::readTypePart()
{
    if (m_depth == 3) {
        m_typeName = attribute("name");
        m_types[m_typeName] = {attribute("unit"), attribute("min"), attribute("max"), {}};
    } else if (m_xml.name() == QLatin1String("Item")) {
        bool isNumber = false;
        const qint64 value = attribute("value").toLongLong(&isNumber);
        if (!isNumber)
            fail(QStringLiteral("the value %1 of an enumeration is not an integer").arg(quoted(attribute("value"))));
        m_types[m_typeName].items.append({value, attribute("name")});
    } else if (m_description.version == 2 && m_depth == 4) {
        m_types[m_typeName] = {attribute("unit"), attribute("min"), attribute("max"), {}};
    }
}

// ---- variables ----

void FmuDescriptionReader::readVariablePart()
{
    if (m_depth == 3) {
        const bool isOf2 = m_description.version == 2;
        const KindName *kind = isOf2 ? nullptr : kindOf(3, m_xml.name());
        m_hasVariable = isOf2 ? m_xml.name() == QLatin1String("ScalarVariable") : kind != nullptr;
        if (m_hasVariable)
            beginVariable(kind ? *kind : kindsOf2[0]);
        return;
    }
    if (!m_hasVariable || m_depth != 4)
        return;
    FmuVariable &variable = m_description.variables.last();
    if (m_description.version == 2) {
        if (const KindName *kind = kindOf(2, m_xml.name())) {
            variable.kind = kind->kind;
            variable.isEnumeration = m_xml.name() == QLatin1String("Enumeration");
            readAttributes(&variable);
        }
    } else if (m_xml.name() == QLatin1String("Dimension")) {
        readDimension();
    } else if (m_xml.name() == QLatin1String("Start")) {
        variable.start = attribute("value");
    } else if (m_xml.name() == QLatin1String("Alias")) {
        addAlias();
    }
}

void FmuDescriptionReader::beginVariable(const KindName &kind)
{
    if (m_description.variables.size() >= FmuDescription::MostVariables) {
        fail(QStringLiteral("there are more than %1 variables").arg(FmuDescription::MostVariables));
        return;
    }
    FmuVariable variable;
    variable.name = attribute("name");
    variable.line = int(m_xml.lineNumber());
    bool isNumber = false;
    variable.reference = attribute("valueReference").toUInt(&isNumber);
    const QString causality = attribute("causality");
    const QString variability = attribute("variability");
    const int causalityIndex = causality.isEmpty() ? int(FmuVariable::Local) : indexOf(causalityNames, causality);
    const int variabilityIndex = variability.isEmpty() ? -1 : indexOf(variabilityNames, variability);
    if (variable.name.isEmpty() || !isNumber || causalityIndex < 0
        || (!variability.isEmpty() && variabilityIndex < 0)) {
        fail(QStringLiteral("variable %1 has no name, no valid valueReference, or an unknown causality or variability")
                 .arg(quoted(variable.name)));
        return;
    }
    variable.kind = kind.kind;
    variable.isEnumeration = m_xml.name() == QLatin1String("Enumeration");
    variable.causality = FmuVariable::Causality(causalityIndex);
    const bool isParameter
        = variable.causality >= FmuVariable::Parameter && variable.causality <= FmuVariable::StructuralParameter;
    const bool isReal = kind.kind == FmuVariable::Float32 || kind.kind == FmuVariable::Float64;
    variable.variability = variabilityIndex >= 0 ? FmuVariable::Variability(variabilityIndex)
        : isParameter                            ? FmuVariable::Fixed
        : isReal                                 ? FmuVariable::Continuous
                                                 : FmuVariable::Discrete;
    variable.initial = attribute("initial");
    variable.description = attribute("description");
    m_description.variables.append(variable);
    if (m_description.version == 3)
        readAttributes(&m_description.variables.last());
}

void FmuDescriptionReader::readAttributes(FmuVariable *variable)
{
    variable->start = attribute("start");
    variable->unit = attribute("unit");
    variable->minimum = attribute("min");
    variable->maximum = attribute("max");
    variable->typeName = attribute("declaredType");
}

void FmuDescriptionReader::readDimension()
{
    Dimension dimension;
    dimension.variable = m_description.variables.size() - 1;
    dimension.line = int(m_xml.lineNumber());
    bool isNumber = false;
    if (m_attributes.hasAttribute(QStringLiteral("start")))
        dimension.size = attribute("start").toInt(&isNumber);
    else
        dimension.reference = attribute("valueReference").toUInt(&isNumber);
    if (!isNumber || dimension.size < 0)
        fail(QStringLiteral("a dimension of variable %1 is neither a number nor a valueReference")
                 .arg(quoted(m_description.variables.last().name)));
    m_dimensions.append(dimension);
}

void FmuDescriptionReader::addAlias()
{
    if (m_description.variables.size() + m_aliases.size() >= FmuDescription::MostVariables)
        fail(QStringLiteral("there are more than %1 variables").arg(FmuDescription::MostVariables));
    m_aliases.append({m_description.variables.size() - 1, attribute("name"), attribute("description")});
}

// ---- all together ----

void FmuDescriptionReader::finish()
{
    const FmuDescription &d = m_description;
    if (!d.hasCoSimulation) {
        fail(0, 0,
             QStringLiteral("the FMU offers %1 only; QtPLC needs co-simulation: export it again with it")
                 .arg(d.otherKinds.isEmpty() ? QStringLiteral("nothing") : d.otherKinds.join(QStringLiteral(" and "))));
        return;
    }
    finishDimensions();
    for (const Alias &alias : qAsConst(m_aliases)) {
        FmuVariable variable = m_description.variables.at(alias.variable);
        variable.name = alias.name;
        variable.description = alias.description;
        m_description.variables.append(variable);
    }
    finishVariables();
}

void FmuDescriptionReader::finishDimensions()
{
    QHash<quint32, int> sizes;  // of structural parameters
    for (const FmuVariable &variable : qAsConst(m_description.variables)) {
        if (variable.causality == FmuVariable::StructuralParameter)
            sizes.insert(variable.reference, variable.start.trimmed().toInt());
    }
    for (const Dimension &dimension : qAsConst(m_dimensions)) {
        FmuVariable &variable = m_description.variables[dimension.variable];
        const int size = dimension.reference ? sizes.value(*dimension.reference, -1) : dimension.size;
        if (size < 0 || qint64(variable.count) * size > FmuDescription::MostElements) {
            fail(dimension.line, 0,
                 QStringLiteral("a dimension of variable %1 does not exist, or is too large")
                     .arg(quoted(variable.name)));
            return;
        }
        variable.dimensions.append(size);
        variable.count *= size;
    }
}

void FmuDescriptionReader::finishVariables()
{
    qint64 elements = 0;
    for (int i = 0; i < m_description.variables.size(); ++i) {
        FmuVariable &variable = m_description.variables[i];
        elements += variable.count;
        if (elements > FmuDescription::MostElements)
            return fail(variable.line, 0,
                        QStringLiteral("the variables have more than %1 elements").arg(FmuDescription::MostElements));
        const TypeDefinition type = m_types.value(variable.typeName);
        variable.items = type.items;
        if (variable.unit.isEmpty())
            variable.unit = type.unit;
        if (variable.minimum.isEmpty())
            variable.minimum = type.minimum;
        if (variable.maximum.isEmpty())
            variable.maximum = type.maximum;
        if (m_description.m_indices.contains(variable.name))
            return fail(variable.line, 0, QStringLiteral("variable %1 is there twice").arg(quoted(variable.name)));
        m_description.m_indices.insert(variable.name, i);
    }
}

bool FmuDescriptionReader::readNumber(const char *name, std::optional<double> *number)
{
    const QString text = attribute(name).trimmed();
    if (text.isEmpty())
        return true;
    bool isNumber = false;
    const double value = text.toDouble(&isNumber);
    if (!isNumber || !std::isfinite(value)) {
        fail(QStringLiteral("%1 = %2 is not a number").arg(QString::fromLatin1(name), quoted(text)));
        return false;
    }
    *number = value;
    return true;
}

bool FmuDescriptionReader::isTrue(const char *name) const
{
    const QString text = attribute(name).trimmed();
    return text == QLatin1String("true") || text == QLatin1String("1");
}

QString FmuDescriptionReader::attribute(const char *name) const
{
    return m_attributes.value(QLatin1String(name)).toString();
}

// ---- look-up ----

const FmuVariable *FmuDescription::find(const QString &name) const
{
    const auto found = m_indices.find(name);
    return found == m_indices.end() ? nullptr : &variables.at(*found);
}

QStringList FmuDescription::closeNames(const QString &name) const
{
    QStringList names;
    for (const FmuVariable &variable : variables) {
        if (names.size() >= 2000)
            break;
        names << variable.name;
    }
    return qplc::closeNames(name, names);
}

}  // namespace qplc
