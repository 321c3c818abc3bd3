// SPDX-License-Identifier: Apache-2.0
#include "EdsFile.h"

#include "signals/IniParser.h"
#include "signals/MessageText.h"
#include "signals/Utf8.h"

#include <QtCore/QMap>
#include <QtCore/QRegularExpression>

namespace qplc {

namespace {

/// An entry of a section, and where it stands.
struct EdsEntry
{
    QString value;
    int line = 0;
    int column = 0;
};

struct EdsSection
{
    ObjectAddress address;
    bool isSub = false;
    int line = 0;
    QMap<QString, EdsEntry> entries;  // keys in lower case

    EdsEntry entry(const char *key) const { return entries.value(QLatin1String(key)); }
};

/// Reads one file.
class EdsReader
{
public:
    EdsReader(const QString &fileName, int node, QVector<QPlcParseError> *errors)
        : m_fileName(fileName)
        , m_node(node)
        , m_errors(errors)
    {
    }

    void readSections(const QByteArray &text);
    QVector<CanOpenObject> objects();
    quint32 identity(const char *key);

private:
    void beginSection(const IniItem &item);
    void addObject(const EdsSection &section, QVector<CanOpenObject> *objects);
    void addCompact(const EdsSection &section, int count, QVector<CanOpenObject> *objects);
    CanOpenObject objectOf(const EdsSection &section);
    std::optional<quint64> valueOf(const EdsSection &section, const RawNumber &number);
    std::optional<qint64> numberOf(const EdsEntry &entry, const QString &what);
    QString nameOf(const EdsSection &section) const;
    void addError(int line, int column, const QString &text);

    const QString m_fileName;
    const int m_node;
    QVector<QPlcParseError> *const m_errors;
    QVector<EdsSection> m_sections;
    QHash<quint32, int> m_sectionOfKey;  // of those of objects; with bit 31 for those of subindices
    QMap<QString, EdsEntry> m_deviceInfo;
    int m_current = -1;  // number of the section; -1: one that is skipped
    bool m_isDeviceInfo = false;
    bool m_isFull = false;
};

void EdsReader::addError(int line, int column, const QString &text)
{
    if (m_errors->size() < EdsFile::MaximumErrors)
        m_errors->append({m_fileName, line, column, text});
}

void EdsReader::readSections(const QByteArray &text)
{
    IniParser parser(text);
    for (IniItem item = parser.next(); item.kind != IniItem::End && !m_isFull; item = parser.next()) {
        if (item.kind == IniItem::Section && item.error.isEmpty())
            beginSection(item);
        else if (!item.error.isEmpty() && (m_current >= 0 || m_isDeviceInfo || item.kind != IniItem::Entry))
            addError(item.line, item.errorColumn, item.error);
        else if (m_isDeviceInfo)
            m_deviceInfo.insert(item.name.toLower(), {item.value, item.line, item.valueColumn});
        else if (m_current >= 0)
            m_sections[m_current].entries.insert(item.name.toLower(), {item.value, item.line, item.valueColumn});
    }
}

void EdsReader::beginSection(const IniItem &item)
{
    static const QRegularExpression pattern(QStringLiteral("^([0-9A-F]{4})(?:sub([0-9A-F]{1,2}))?$"),
                                            QRegularExpression::CaseInsensitiveOption);
    m_current = -1;
    m_isDeviceInfo = item.name.compare(QLatin1String("DeviceInfo"), Qt::CaseInsensitive) == 0;
    const QRegularExpressionMatch match = pattern.match(item.name);
    if (!match.hasMatch())
        return;
    EdsSection section;
    section.isSub = !match.captured(2).isEmpty();
    section.address = {quint16(match.captured(1).toUInt(nullptr, 16)), quint8(match.captured(2).toUInt(nullptr, 16))};
    section.line = item.line;
    const quint32 key = section.address.key() | (section.isSub ? 0x80000000U : 0U);
    if (m_sectionOfKey.contains(key)) {
        addError(item.line, item.column,
                 QStringLiteral("section %1 is there twice; remove one of them").arg(quoted(item.name)));
        return;
    }
    if (m_sections.size() >= EdsFile::MaximumObjects) {
        addError(item.line, item.column,
                 QStringLiteral("the file has more than %1 objects; remove those that nobody uses")
                     .arg(EdsFile::MaximumObjects));
        m_isFull = true;
        return;
    }
    m_current = m_sections.size();
    m_sectionOfKey.insert(key, m_current);
    m_sections.append(section);
}

QVector<CanOpenObject> EdsReader::objects()
{
    QVector<CanOpenObject> objects;
    for (const EdsSection &section : qAsConst(m_sections)) {
        if (objects.size() >= EdsFile::MaximumObjects)
            break;
        addObject(section, &objects);
    }
    return objects;
}

// A section describes an object, or one that has others under its subindices.
void EdsReader::addObject(const EdsSection &section, QVector<CanOpenObject> *objects)
{
    const EdsEntry compact = section.entry("compactsubobj");
    const qint64 count = numberOf(compact, QStringLiteral("CompactSubObj")).value_or(0);
    if (count < 0 || count > 254)
        return addError(compact.line, compact.column,
                        QStringLiteral("%1 is no number of subindices; write 1 to 254").arg(quoted(compact.value)));
    if (!section.isSub && count > 0)
        return addCompact(section, int(count), objects);
    const bool hasSubs = !section.isSub && !section.entry("subnumber").value.isEmpty();
    if (section.entry("datatype").value.isEmpty()) {
        if (section.isSub)
            addError(section.line, 2,
                     QStringLiteral("object %1 has no DataType; add for example 'DataType=0x0007'")
                         .arg(section.address.toText()));
        return;
    }
    if (!hasSubs)
        objects->append(objectOf(section));
}

// Subindices that are alike stand in one section.
void EdsReader::addCompact(const EdsSection &section, int count, QVector<CanOpenObject> *objects)
{
    CanOpenObject number;
    number.address = section.address;
    number.name = nameOf(section) + QStringLiteral(".Count");
    number.number = RawNumber{RawNumber::Unsigned, 8};
    number.isWritable = false;
    number.value = quint64(count);
    objects->append(number);
    CanOpenObject object = objectOf(section);
    const QString name = object.name;
    for (int sub = 1; sub <= count; ++sub) {
        object.address.sub = quint8(sub);
        object.name = name + QLatin1Char('.') + QString::number(sub);
        objects->append(object);
    }
}

CanOpenObject EdsReader::objectOf(const EdsSection &section)
{
    CanOpenObject object;
    object.address = section.address;
    object.name = nameOf(section);
    const EdsEntry type = section.entry("datatype");
    const qint64 code = numberOf(type, QStringLiteral("DataType")).value_or(0);
    if (code < 0 || code > 0xFFFF)
        addError(type.line, type.column,
                 QStringLiteral("%1 is no data type; write for example 0x0007").arg(quoted(type.value)));
    object.number = CanOpenObject::numberOfType(quint16(code));
    const QString access = section.entry("accesstype").value.toLower();
    object.isWritable = access != QLatin1String("ro") && access != QLatin1String("const");
    if (object.number)
        object.value = valueOf(section, *object.number);
    return object;
}

std::optional<quint64> EdsReader::valueOf(const EdsSection &section, const RawNumber &number)
{
    EdsEntry entry = section.entry("parametervalue");
    if (entry.value.isEmpty())
        entry = section.entry("defaultvalue");
    if (entry.value.isEmpty() || number.kind == RawNumber::Float)
        return std::nullopt;
    const std::optional<qint64> value
        = numberOf(entry, QStringLiteral("the value of object ") + section.address.toText());
    if (!value)
        return std::nullopt;
    const bool isWide = number.bits >= 64;
    const bool isTooLow = !isWide && *value < -(qint64(1) << (number.bits - 1));
    const bool isTooHigh = !isWide && *value >= qint64(1) << number.bits;
    if (isTooLow || isTooHigh) {
        addError(entry.line, entry.column,
                 QStringLiteral("%1 does not fit into the %2 bits of object %3; look at its DataType")
                     .arg(quoted(entry.value))
                     .arg(number.bits)
                     .arg(section.address.toText()));
        return std::nullopt;
    }
    return quint64(*value) & RawNumber::lowBits(number.bits);
}

// "5", "0x5", "05" (octal), "$NODEID+0x180"; nothing for an empty text.
std::optional<qint64> EdsReader::numberOf(const EdsEntry &entry, const QString &what)
{
    QString text = entry.value.simplified().toLower().remove(QLatin1Char(' '));
    qint64 sum = 0;
    const QString nodeWord = QStringLiteral("$nodeid");
    if (text.contains(nodeWord)) {
        sum = m_node;
        text.remove(text.indexOf(nodeWord), nodeWord.size());
        if (text.startsWith(QLatin1Char('+')))
            text.remove(0, 1);
        if (text.endsWith(QLatin1Char('+')))
            text.chop(1);
        if (text.isEmpty())
            return sum;
    }
    if (text.isEmpty())
        return std::nullopt;
    bool isNumber = false;
    qint64 value = text.toLongLong(&isNumber, 0);
    if (!isNumber)
        value = qint64(text.toULongLong(&isNumber, 0));
    if (!isNumber || value > std::numeric_limits<qint64>::max() - sum) {
        addError(entry.line, entry.column,
                 QStringLiteral("%1 is not a whole number (%2); write for example 12, 0x0C or $NODEID+0x180")
                     .arg(quoted(entry.value), what));
        return std::nullopt;
    }
    return value + sum;
}

QString EdsReader::nameOf(const EdsSection &section) const
{
    const auto wordOf = [](const QString &name) {
        QString word;
        bool isBegin = true;
        for (const QChar character : name) {
            const bool isPart = character.isLetterOrNumber() && character.unicode() < 0x80;
            if (isPart)
                word += isBegin ? character.toUpper() : character;
            isBegin = !isPart;
        }
        return word;
    };
    const QString own = wordOf(section.entry("parametername").value);
    if (!section.isSub)
        return own;
    const int parent = m_sectionOfKey.value(ObjectAddress{section.address.index, 0}.key(), -1);
    const QString of = parent < 0 ? QString() : wordOf(m_sections.at(parent).entry("parametername").value);
    return of.isEmpty() ? own : of + QLatin1Char('.') + own;
}

quint32 EdsReader::identity(const char *key)
{
    return quint32(numberOf(m_deviceInfo.value(QLatin1String(key)), QLatin1String(key)).value_or(0));
}

}  // namespace

EdsFile EdsFile::fromText(const QByteArray &text, const QString &fileName, int node, QVector<QPlcParseError> *errors)
{
    const int before = errors->size();
    EdsFile file;
    QVector<QPlcParseError> own;
    EdsReader reader(fileName, node, &own);
    reader.readSections(firstInvalidUtf8(text.constData(), text.size()) < 0 ? text
                                                                            : QString::fromLatin1(text).toUtf8());
    file.m_dictionary = CanOpenDictionary(reader.objects());
    file.m_vendor = reader.identity("vendornumber");
    file.m_product = reader.identity("productnumber");
    if (own.isEmpty() && file.m_dictionary.objects().isEmpty())
        own.append({fileName, 0, 0,
                    QStringLiteral("this is no EDS file: it has no object; its sections are for example [1000] and "
                                   "[1018sub1]")});
    *errors += own;
    return errors->size() == before ? file : EdsFile();
}

EdsFile EdsFile::fromFile(const QString &fileName, int node, QVector<QPlcParseError> *errors)
{
    QByteArray text;
    if (!IniParser::readFile(fileName, QStringLiteral("an EDS file"), MaximumSize, &text, errors))
        return {};
    return fromText(text, fileName, node, errors);
}

}  // namespace qplc
