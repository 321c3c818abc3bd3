// SPDX-License-Identifier: Apache-2.0
#include "LayoutJson.h"

#include "LayoutReader.h"
#include "gui/WindowText.h"
#include "signals/BoundedRead.h"
#include "signals/JsonNames.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QSaveFile>

namespace qplc {

/// Sees the parts of a layout that only files have.
class LayoutWriter
{
public:
    static QJsonObject root(const Layout &layout)
    {
        QJsonArray tabs;
        for (const LayoutTab &each : layout.tabs())
            tabs.append(tab(each));
        QJsonArray windows;
        for (const LayoutWindow &each : layout.windows())
            windows.append(window(each));
        QJsonObject json = layout.m_otherKeys;
        json.insert(QStringLiteral("format"), QStringLiteral("QtPLC layout"));
        json.insert(QStringLiteral("version"), LayoutVersion);
        json.insert(QStringLiteral("currentTab"), layout.m_currentTab);
        json.insert(QStringLiteral("tabs"), tabs);
        json.insert(QStringLiteral("windows"), windows);
        return json;
    }

private:
    static QJsonObject tab(const LayoutTab &tab)
    {
        QJsonObject json = page(tab);
        json.insert(QStringLiteral("name"), tab.name);
        return json;
    }

    static QJsonObject window(const LayoutWindow &window)
    {
        QJsonObject json = page(window);
        QJsonObject geometry = window.otherGeometryKeys;
        geometry.insert(QStringLiteral("x"), window.geometry.x());
        geometry.insert(QStringLiteral("y"), window.geometry.y());
        geometry.insert(QStringLiteral("width"), window.geometry.width());
        geometry.insert(QStringLiteral("height"), window.geometry.height());
        json.insert(QStringLiteral("geometry"), geometry);
        if (window.home)
            json.insert(QStringLiteral("home"), home(*window.home));
        return json;
    }

    static QJsonObject page(const LayoutPage &page)
    {
        QJsonObject json = page.otherKeys;
        json.insert(QStringLiteral("id"), page.id);
        if (page.tree)
            json.insert(QStringLiteral("tree"), node(*page.tree));
        if (!page.maximized.isEmpty())
            json.insert(QStringLiteral("maximized"), page.maximized);
        return json;
    }

    static QJsonObject node(const LayoutNode &node)
    {
        QJsonObject json = node.isPanel() ? node.panel.otherKeys : node.otherKeys;
        if (node.isPanel()) {
            json.insert(QStringLiteral("id"), node.panel.id);
            json.insert(QStringLiteral("type"), node.panel.type);
            json.insert(QStringLiteral("settings"), node.panel.settings);
            return json;
        }
        json.insert(QStringLiteral("split"), layoutOrientationWords().at(node.orientation == Qt::Horizontal ? 0 : 1));
        QJsonArray children;
        for (const LayoutNode &child : node.children) {
            QJsonObject entry = LayoutWriter::node(child);
            entry.insert(QStringLiteral("share"), share(child.share));
            children.append(entry);
        }
        json.insert(QStringLiteral("children"), children);
        return json;
    }

    static QJsonObject home(const LayoutHome &home)
    {
        QJsonObject json = home.otherKeys;
        json.insert(QStringLiteral("tab"), home.tab);
        json.insert(QStringLiteral("side"), layoutSideWords().at(int(home.side)));
        json.insert(QStringLiteral("share"), share(home.share));
        if (!home.beside.first.isEmpty()) {
            json.insert(QStringLiteral("first"), home.beside.first);
            json.insert(QStringLiteral("last"), home.beside.last);
        }
        return json;
    }

    static double share(int share) { return share / double(LayoutNode::WholeShare); }
};

namespace {

void setError(QPlcParseError *error, const QPlcParseError &value)
{
    if (error)
        *error = value;
}

/// Where a text cannot be read as JSON.
QPlcParseError syntaxError(const QByteArray &text, const QJsonParseError &json)
{
    const QByteArray before = text.left(json.offset);
    QPlcParseError error;
    error.line = before.count('\n') + 1;
    error.column = QString::fromUtf8(before.mid(before.lastIndexOf('\n') + 1)).size() + 1;
    error.message = WindowText::tr("this is not JSON (%1): correct it, or choose another file").arg(json.errorString());
    return error;
}

}  // namespace

QByteArray layoutToJson(const Layout &layout)
{
    return QJsonDocument(LayoutWriter::root(layout)).toJson(QJsonDocument::Indented);
}

std::optional<Layout> layoutFromJson(const QByteArray &text, QPlcParseError *error)
{
    if (const std::optional<QString> name = doubledJsonName(text)) {
        QPlcParseError doubled;
        doubled.message
            = WindowText::tr("an object has the name \"%1\" twice; remove one of them, or choose another layout")
                  .arg(*name);
        setError(error, doubled);
        return {};
    }
    QJsonParseError json;
    const QJsonDocument document = QJsonDocument::fromJson(text, &json);
    if (json.error != QJsonParseError::NoError) {
        setError(error, syntaxError(text, json));
        return {};
    }
    QPlcParseError structure;
    const std::optional<Layout> layout = readLayout(document.object(), &structure.message);
    if (layout)
        return layout;
    structure.message = WindowText::tr("%1; correct it, or choose another layout").arg(structure.message);
    setError(error, structure);
    return {};
}

std::optional<Layout> readLayoutFile(const QString &fileName, QPlcParseError *error)
{
    constexpr qint64 LargestFile = 16 * 1024 * 1024;
    QFile file(fileName);
    QPlcParseError inFile;
    std::optional<Layout> layout;
    if (!file.open(QIODevice::ReadOnly)) {
        inFile.message
            = WindowText::tr("the layout cannot be read (%1): check name and rights").arg(file.errorString());
    } else {
        const QByteArray text = readBounded(&file, LargestFile);
        if (text.size() > LargestFile)
            inFile.message = WindowText::tr("a layout has at most 16 MiB: choose another file");
        else
            layout = layoutFromJson(text, &inFile);
    }
    inFile.file = fileName;
    if (!layout)
        setError(error, inFile);
    return layout;
}

bool writeLayoutFile(const Layout &layout, const QString &fileName, QString *error)
{
    QSaveFile file(fileName);
    const QByteArray text = layoutToJson(layout);
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit())
        return true;
    if (error)
        *error = WindowText::tr("layout '%1' cannot be written (%2): check folder, rights and space")
                     .arg(fileName, file.errorString());
    return false;
}

}  // namespace qplc
