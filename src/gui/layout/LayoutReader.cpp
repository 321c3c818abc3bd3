// SPDX-License-Identifier: Apache-2.0
#include "LayoutReader.h"

#include "LayoutJson.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace qplc {

namespace {

// The time of a window to arrange splits grows with the third power of their depth: 0.3 s for 50, a
// minute for 400.
constexpr int deepest = 50;

QJsonObject without(QJsonObject json, std::initializer_list<const char *> keys)
{
    for (const char *key : keys)
        json.remove(QLatin1String(key));
    return json;
}

QString below(const QString &place, const QString &key)
{
    return place.isEmpty() ? key : place + QLatin1Char('.') + key;
}

/// How much a file asks for, told before anything of it is built.
struct LayoutSize
{
    int panels = 0;
    int splits = 0;
    int depth = 0;  // splits within each other

    void add(const QJsonValue &node, int splitsAround = 0)
    {
        const QJsonObject json = node.toObject();
        if (!json.contains(QStringLiteral("split"))) {
            ++panels;
            return;
        }
        ++splits;
        depth = std::max(depth, splitsAround + 1);
        const QJsonArray children = json.value(QStringLiteral("children")).toArray();
        for (const QJsonValue &child : children)
            add(child, splitsAround + 1);
    }
    void addPages(const QJsonArray &pages)
    {
        for (const QJsonValue &page : pages) {
            const QJsonObject json = page.toObject();
            if (json.contains(QStringLiteral("tree")))
                add(json.value(QStringLiteral("tree")));
        }
    }
};

QString entry(const QString &place, int index)
{
    return QStringLiteral("%1[%2]").arg(place).arg(index);
}

/// A value as it stands in the file, short enough for a sentence.
QString shown(const QJsonValue &value)
{
    if (value.isUndefined())
        return QCoreApplication::translate("qplc::LayoutReader", "is missing");
    const QByteArray json = QJsonDocument(QJsonArray{value}).toJson(QJsonDocument::Compact);
    const QString text = QString::fromUtf8(json.mid(1, json.size() - 2));
    return QCoreApplication::translate("qplc::LayoutReader", "is %1")
        .arg(text.size() > 40 ? text.left(40) + QStringLiteral("...") : text);
}

}  // namespace

const QStringList &layoutOrientationWords()
{
    static const QStringList words{QStringLiteral("horizontal"), QStringLiteral("vertical")};
    return words;
}

const QStringList &layoutSideWords()
{
    static const QStringList words{QStringLiteral("left"), QStringLiteral("right"), QStringLiteral("above"),
                                   QStringLiteral("below")};
    return words;
}

/// Makes a layout of JSON, and keeps the first thing that is wrong: its place
/// ("tabs[0].tree.children[1].share") and a sentence.
class LayoutReader
{
    Q_DECLARE_TR_FUNCTIONS(qplc::LayoutReader)

public:
    explicit LayoutReader(const QJsonObject &root)
    {
        readRoot(root);
        if (!hasError() && !m_layout.invariantError().isEmpty())
            fail(QString(), m_layout.invariantError());
    }

    bool hasError() const { return !m_error.isEmpty(); }
    const QString &error() const { return m_error; }
    const Layout &layout() const { return m_layout; }

private:
    void readRoot(const QJsonObject &root)
    {
        if (root.value(QStringLiteral("format")).toString() != QLatin1String("QtPLC layout"))
            return fail(QStringLiteral("format"),
                        tr("must be \"QtPLC layout\", and %1: this is not a layout; choose another file")
                            .arg(shown(root.value(QStringLiteral("format")))));
        const int version = number(root, QStringLiteral("version"), QString());
        if (version > LayoutVersion)
            return fail(QStringLiteral("version"),
                        tr("is %1, and this program reads versions up to %2: open it with a newer program")
                            .arg(version)
                            .arg(LayoutVersion));
        if (version < 1)
            return fail(QStringLiteral("version"),
                        tr("must be a number from 1 to %1, and %2")
                            .arg(LayoutVersion)
                            .arg(shown(root.value(QStringLiteral("version")))));
        m_layout.m_tabs.clear();
        const QJsonArray tabs = array(root, QStringLiteral("tabs"), QString());
        const QJsonArray windows = array(root, QStringLiteral("windows"), QString());
        checkSize(tabs, windows);
        for (int i = 0; i < tabs.size() && !hasError(); ++i) {
            const QString place = entry(QStringLiteral("tabs"), i);
            m_layout.m_tabs.push_back(readTab(object(tabs.at(i), place), place));
        }
        for (int i = 0; i < windows.size() && !hasError(); ++i) {
            const QString place = entry(QStringLiteral("windows"), i);
            m_layout.m_windows.push_back(readWindow(object(windows.at(i), place), place));
        }
        m_layout.m_currentTab = text(root, QStringLiteral("currentTab"), QString());
        if (!hasError() && !m_layout.tab(m_layout.m_currentTab))
            fail(QStringLiteral("currentTab"), tr("is not the id of a tab: \"%1\"").arg(m_layout.m_currentTab));
        m_layout.m_otherKeys = without(root, {"format", "version", "tabs", "windows", "currentTab"});
    }

    void checkSize(const QJsonArray &tabs, const QJsonArray &windows)
    {
        if (tabs.isEmpty())
            fail(QStringLiteral("tabs"), tr("must have at least one tab"));
        LayoutSize size;
        size.addPages(tabs);
        size.addPages(windows);
        const auto check = [this](const QString &what, int count, int most) {
            if (count > most)
                fail(QString(), tr("a layout has at most %1 %2, and this one has %3").arg(most).arg(what).arg(count));
        };
        check(tr("tabs"), tabs.size(), Layout::MostPanels);
        check(tr("panels"), size.panels, Layout::MostPanels);
        check(tr("splits"), size.splits, Layout::MostPanels);
        check(tr("splits within each other"), size.depth, deepest);
    }

    LayoutTab readTab(const QJsonObject &json, const QString &place)
    {
        LayoutTab tab;
        readPage(json, place, &tab);
        tab.name = text(json, QStringLiteral("name"), place);
        tab.otherKeys = without(tab.otherKeys, {"name"});
        return tab;
    }

    LayoutWindow readWindow(const QJsonObject &json, const QString &place)
    {
        LayoutWindow window;
        readPage(json, place, &window);
        if (!window.tree)
            fail(below(place, QStringLiteral("tree")), tr("is missing: a window without panels is of no use"));
        const QString geometryPlace = below(place, QStringLiteral("geometry"));
        const QJsonObject geometry = object(json.value(QStringLiteral("geometry")), geometryPlace);
        window.geometry = readGeometry(geometry, geometryPlace);
        window.otherGeometryKeys = without(geometry, {"x", "y", "width", "height"});
        if (json.contains(QStringLiteral("home"))) {
            const QString homePlace = below(place, QStringLiteral("home"));
            window.home = readHome(object(json.value(QStringLiteral("home")), homePlace), homePlace);
        }
        window.otherKeys = without(window.otherKeys, {"geometry", "home"});
        return window;
    }

    void readPage(const QJsonObject &json, const QString &place, LayoutPage *page)
    {
        page->id = text(json, QStringLiteral("id"), place);
        page->maximized = optionalText(json, QStringLiteral("maximized"), place);
        if (json.contains(QStringLiteral("tree")) && !hasError()) {
            const QString treePlace = below(place, QStringLiteral("tree"));
            page->tree = readNode(object(json.value(QStringLiteral("tree")), treePlace), treePlace);
            if (!hasError())
                page->tree->normalize();
        }
        page->otherKeys = without(json, {"id", "maximized", "tree"});
    }

    LayoutNode readNode(const QJsonObject &json, const QString &place)
    {
        if (json.contains(QStringLiteral("split")))
            return readSplit(json, place);
        LayoutNode node;
        node.panel = readPanel(json, place);
        return node;
    }

    LayoutNode readSplit(const QJsonObject &json, const QString &place)
    {
        LayoutNode node;
        const int word = choice(json, QStringLiteral("split"), layoutOrientationWords(), place);
        node.orientation = word == 0 ? Qt::Horizontal : Qt::Vertical;
        const QJsonArray children = array(json, QStringLiteral("children"), place);
        const QString childrenPlace = below(place, QStringLiteral("children"));
        if (children.isEmpty())
            fail(childrenPlace, tr("must have at least one entry"));
        QVector<double> shares;
        for (int i = 0; i < children.size() && !hasError(); ++i) {
            const QString childPlace = entry(childrenPlace, i);
            const QJsonObject child = object(children.at(i), childPlace);
            shares.append(share(child, childPlace));
            node.children.push_back(readNode(child, childPlace));
        }
        if (hasError())
            return {};
        const QVector<int> whole = layoutShares(shares);
        for (int i = 0; i < whole.size(); ++i)
            node.children[std::size_t(i)].share = whole.at(i);
        node.otherKeys = without(json, {"split", "children", "share"});
        return node;
    }

    LayoutPanel readPanel(const QJsonObject &json, const QString &place)
    {
        LayoutPanel panel;
        panel.id = text(json, QStringLiteral("id"), place);
        panel.type = text(json, QStringLiteral("type"), place);
        if (json.contains(QStringLiteral("settings")))
            panel.settings = object(json.value(QStringLiteral("settings")), below(place, QStringLiteral("settings")));
        panel.otherKeys = without(json, {"id", "type", "settings", "share"});
        return panel;
    }

    QRect readGeometry(const QJsonObject &json, const QString &place)
    {
        const QRect geometry(number(json, QStringLiteral("x"), place), number(json, QStringLiteral("y"), place),
                             number(json, QStringLiteral("width"), place),
                             number(json, QStringLiteral("height"), place));
        if (!geometry.isValid())
            fail(place, tr("must have a width and a height above 0"));
        return geometry;
    }

    LayoutHome readHome(const QJsonObject &json, const QString &place)
    {
        LayoutHome home;
        home.tab = text(json, QStringLiteral("tab"), place);
        home.beside.first = optionalText(json, QStringLiteral("first"), place);
        home.beside.last = optionalText(json, QStringLiteral("last"), place);
        home.side = LayoutSide(choice(json, QStringLiteral("side"), layoutSideWords(), place));
        home.share = qBound(1, qRound(share(json, place) * LayoutNode::WholeShare), LayoutNode::WholeShare);
        home.otherKeys = without(json, {"tab", "first", "last", "side", "share"});
        return home;
    }

    QString text(const QJsonObject &json, const QString &key, const QString &place)
    {
        const QJsonValue value = json.value(key);
        if (value.toString().isEmpty())
            fail(below(place, key), tr("must be a text that is not empty, and %1").arg(shown(value)));
        return value.toString();
    }

    QString optionalText(const QJsonObject &json, const QString &key, const QString &place)
    {
        return json.contains(key) ? text(json, key, place) : QString();
    }

    int number(const QJsonObject &json, const QString &key, const QString &place)
    {
        const QJsonValue value = json.value(key);
        const double number = value.toDouble(0.5);
        if (number != std::floor(number) || std::abs(number) > 1e6) {
            fail(below(place, key), tr("must be a whole number, and %1").arg(shown(value)));
            return 0;
        }
        return static_cast<int>(number);
    }

    double share(const QJsonObject &json, const QString &place)
    {
        const QJsonValue value = json.value(QStringLiteral("share"));
        const double share = value.toDouble(-1);
        if (share > 0 && share <= 1e6)
            return share;
        fail(below(place, QStringLiteral("share")), tr("must be a number above 0, and %1").arg(shown(value)));
        return 1;
    }

    int choice(const QJsonObject &json, const QString &key, const QStringList &choices, const QString &place)
    {
        const QJsonValue value = json.value(key);
        const int index = choices.indexOf(value.toString());
        if (index < 0)
            fail(below(place, key),
                 tr("must be one of %1, and %2").arg(choices.join(QStringLiteral(", ")), shown(value)));
        return std::max(index, 0);
    }

    QJsonObject object(const QJsonValue &value, const QString &place)
    {
        if (!value.isObject())
            fail(place, tr("must be an object, and %1").arg(shown(value)));
        return value.toObject();
    }

    QJsonArray array(const QJsonObject &json, const QString &key, const QString &place)
    {
        const QJsonValue value = json.value(key);
        if (!value.isArray())
            fail(below(place, key), tr("must be an array, and %1").arg(shown(value)));
        return value.toArray();
    }

    void fail(const QString &place, const QString &what)
    {
        if (!hasError())
            m_error = place.isEmpty() ? what : QStringLiteral("%1 %2").arg(place, what);
    }

    Layout m_layout;
    QString m_error;
};

std::optional<Layout> readLayout(const QJsonObject &root, QString *error)
{
    const LayoutReader reader(root);
    *error = reader.error();
    return reader.hasError() ? std::nullopt : std::optional<Layout>(reader.layout());
}

}  // namespace qplc
