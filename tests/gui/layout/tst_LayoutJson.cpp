// SPDX-License-Identifier: Apache-2.0
#include "LayoutFixtures.h"
#include "gui/layout/LayoutJson.h"

#include <QtTest/QtTest>

using namespace qplc;

namespace {

const QByteArray Panel = R"({"id": "p", "type": "Gauge", "settings": {}, "share": 1})";

QByteArrayList many(int count, const QByteArray &child)
{
    return QVector<QByteArray>(count, child).toList();
}

QByteArray split(const QByteArray &orientation, const QByteArrayList &children)
{
    return R"({"share": 1, "split": ")" + orientation + R"(", "children": [)" + children.join(',') + "]}";
}

QByteArray withTree(const QByteArray &tree)
{
    return R"({"format": "QtPLC layout", "version": 1, "windows": [], "currentTab": "a", "tabs": [)"
           R"({"id": "a", "name": "A", "tree": )"
        + tree + "}]}";
}

/// As layoutToJson() writes it, with a key of its own at every level.
const QByteArray WithOtherKeys = R"({
    "currentTab": "tab1",
    "format": "QtPLC layout",
    "laterRoot": true,
    "tabs": [
        {
            "id": "tab1",
            "laterTab": [
                1,
                2.5
            ],
            "maximized": "panel2",
            "name": "Fly",
            "tree": {
                "children": [
                    {
                        "id": "panel1",
                        "laterPanel": null,
                        "settings": {
                            "laterSetting": 9007199254740991
                        },
                        "share": 0.25,
                        "type": "Time plot"
                    },
                    {
                        "id": "panel2",
                        "settings": {
                        },
                        "share": 0.75,
                        "type": "Nobody knows this"
                    }
                ],
                "laterSplit": "x",
                "split": "horizontal"
            }
        }
    ],
    "version": 1,
    "windows": [
        {
            "geometry": {
                "height": 200,
                "laterGeometry": 1,
                "width": 300,
                "x": 10,
                "y": -20
            },
            "home": {
                "first": "panel1",
                "last": "panel2",
                "laterHome": {
                },
                "share": 0.3333,
                "side": "below",
                "tab": "tab1"
            },
            "id": "window1",
            "laterWindow": 1,
            "tree": {
                "id": "panel3",
                "settings": {
                    "title": "Höhe"
                },
                "type": "Gauge"
            }
        }
    ]
}
)";

QByteArray with(QByteArray text, const char *from, const char *to)
{
    const int place = text.indexOf(from);
    return place < 0 ? QByteArray("the test is wrong") : text.replace(place, int(qstrlen(from)), to);
}

}  // namespace

class tst_LayoutJson : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void unknownKeysAreWrittenBackByteForByte();
    void unknownKeysSurviveEdits();
    void handwrittenTreeIsRepaired();
    void badTextIsRefusedWithPlaceAndRemedy_data();
    void badTextIsRefusedWithPlaceAndRemedy();
    void fileIsWrittenAndReadBack();
    void fileThatCannotBeReadOrWrittenIsNamed();
    void badFileIsNamed();
};

void tst_LayoutJson::unknownKeysAreWrittenBackByteForByte()
{
    QPlcParseError error;
    const std::optional<Layout> layout = layoutFromJson(WithOtherKeys, &error);
    QVERIFY2(layout, qPrintable(error.toString()));
    QCOMPARE(layoutToJson(*layout), WithOtherKeys);
    QCOMPARE(described(*layout), QStringLiteral("H[panel1 panel2] / panel3"));
    QCOMPARE(layout->windows().front().geometry, QRect(10, -20, 300, 200));
}

void tst_LayoutJson::unknownKeysSurviveEdits()
{
    Layout layout = *layoutFromJson(WithOtherKeys);
    layout.movePanel("panel1", LayoutTarget::inNewTab("Other"));
    layout.renameTab("tab1", "Power");
    const QByteArray text = layoutToJson(layout);
    for (const char *key : {"laterRoot", "laterTab", "laterPanel", "laterSetting", "laterWindow", "laterGeometry"})
        QVERIFY2(text.contains(key), key);
}

void tst_LayoutJson::handwrittenTreeIsRepaired()
{
    const std::optional<Layout> layout = layoutFromJson(R"({"format": "QtPLC layout", "version": 1, "currentTab": "a",
        "windows": [], "tabs": [{"id": "a", "name": "A", "tree": {"split": "horizontal", "children": [
            {"share": 1, "id": "p", "type": "Gauge"},
            {"share": 3, "split": "horizontal", "children": [
                {"share": 1, "id": "q", "type": "Gauge"},
                {"share": 2, "split": "vertical", "children": [{"share": 7, "id": "r", "type": "Gauge"}]}]}]}}]})");
    QVERIFY(layout);
    QCOMPARE(described(*layout), QStringLiteral("H[p q r]"));
    QCOMPARE(layout->currentTab().tree->shares(), (QVector<int>{2500, 2500, 5000}));
}

void tst_LayoutJson::badTextIsRefusedWithPlaceAndRemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char *name, const QByteArray &text, const char *expected) {
        QTest::newRow(name) << text << QString::fromUtf8(expected);
    };
    row("empty", "", "1:1: this is not JSON");
    row("cut", WithOtherKeys.left(60), "this is not JSON");
    row("syntax", with(WithOtherKeys, "\"currentTab\":", "\"currentTab\""), "2:19: this is not JSON");
    row("name there twice", with(WithOtherKeys, "\"share\": 0.25", "\"share\": 0.25, \"share\": [0.5]"),
        "an object has the name \"share\" twice; remove one of them, or choose another");
    row("array", "[]", "format must be \"QtPLC layout\", and is missing: this is not a layout; choose another file");
    row("other format", with(WithOtherKeys, "QtPLC layout", "something"), "and is \"something\"");
    row("newer", with(WithOtherKeys, "\"version\": 1", "\"version\": 2"),
        "version is 2, and this program reads versions up to 1: open it with a newer program");
    row("no version", with(WithOtherKeys, "\"version\": 1", "\"verbatim\": 1"),
        "version must be a whole number, and is missing");
    row("version 0", with(WithOtherKeys, "\"version\": 1", "\"version\": 0"), "version must be a number from 1 to 1");
    row("version text", with(WithOtherKeys, "\"version\": 1", "\"version\": \"1\""), "and is \"1\"");
    row("no tabs", R"({"format": "QtPLC layout", "version": 1, "tabs": [], "windows": [], "currentTab": "a"})",
        "tabs must have at least one tab");
    row("tab is a text", R"({"format": "QtPLC layout", "version": 1, "tabs": ["a"], "windows": [], "currentTab": "a"})",
        "tabs[0] must be an object, and is \"a\"");
    row("unknown current tab", with(WithOtherKeys, "\"tab1\"", "\"tab7\""),
        "currentTab is not the id of a tab: \"tab7\"");
    row("no name", with(WithOtherKeys, "\"name\": \"Fly\"", "\"name\": \"\""),
        "tabs[0].name must be a text that is not empty");
    row("share of nothing", with(WithOtherKeys, "0.25", "0"),
        "tabs[0].tree.children[0].share must be a number above 0, and is 0");
    row("share of a text", with(WithOtherKeys, "0.75", "\"big\""),
        "tabs[0].tree.children[1].share must be a number above 0, and is \"big\"");
    row("diagonal", with(WithOtherKeys, "\"horizontal\"", "\"diagonal\""),
        "tabs[0].tree.split must be one of horizontal, vertical, and is \"diagonal\"");
    row("id there twice", with(WithOtherKeys, "\"id\": \"panel3\"", "\"id\": \"panel1\""),
        "id 'panel1' is empty or there twice");
    row("no type", with(WithOtherKeys, "\"type\": \"Gauge\"", "\"sort\": \"Gauge\""),
        "windows[0].tree.type must be a text that is not empty, and is missing");
    row("settings", with(WithOtherKeys, "{\n                    \"title\": \"Höhe\"\n                }", "5"),
        "windows[0].tree.settings must be an object, and is 5");
    row("maximized nobody", with(WithOtherKeys, "\"maximized\": \"panel2\"", "\"maximized\": \"panel3\""),
        "has no panel 'panel3' to show alone");
    row("width", with(WithOtherKeys, "\"width\": 300", "\"width\": 0"),
        "windows[0].geometry must have a width and a height above 0");
    row("half a pixel", with(WithOtherKeys, "\"x\": 10", "\"x\": 10.5"),
        "windows[0].geometry.x must be a whole number, and is 10.5");
    row("side", with(WithOtherKeys, "\"below\"", "\"under\""),
        "windows[0].home.side must be one of left, right, above, below, and is \"under\"");
    row("no children", R"({"format": "QtPLC layout", "version": 1, "windows": [], "currentTab": "a",
        "tabs": [{"id": "a", "name": "A", "tree": {"split": "vertical", "children": []}}]})",
        "tabs[0].tree.children must have at least one entry");
    row("panels", withTree(split("vertical", many(501, Panel))),
        "a layout has at most 500 panels, and this one has 501");
    row("panels of splits that would be merged",
        withTree(split("vertical", many(1000, split("vertical", many(20, Panel))))),
        "a layout has at most 500 panels, and this one has 20000");
    QByteArray chain = Panel;
    for (int i = 0; i < 400; ++i)
        chain = split("horizontal", {chain});
    row("splits", withTree(split("vertical", {chain, chain})), "a layout has at most 500 splits, and this one has 801");
    QByteArray nested = Panel;
    for (int i = 0; i < 51; ++i)
        nested = split(i % 2 == 0 ? "horizontal" : "vertical", {nested, Panel});
    row("splits within splits", withTree(nested),
        "a layout has at most 50 splits within each other, and this one has 51");
    row("tabs",
        R"({"format": "QtPLC layout", "version": 1, "windows": [], "currentTab": "a", "tabs": [)"
            + many(501, R"({"id": "a", "name": "A"})").join(',') + "]}",
        "a layout has at most 500 tabs, and this one has 501");
    row("deep", QByteArray(100000, '['), "this is not JSON");
}

void tst_LayoutJson::badTextIsRefusedWithPlaceAndRemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, expected);
    QPlcParseError error;
    QVERIFY(!layoutFromJson(text, &error));
    QVERIFY2(error.toString().contains(expected), qPrintable(error.toString()));
    QVERIFY2(error.message.contains("choose another") || error.message.contains("newer program"),
             qPrintable(error.message));
    QVERIFY(!layoutFromJson(text));
}

void tst_LayoutJson::fileIsWrittenAndReadBack()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("fly.json"));
    QString writeError;
    QVERIFY2(writeLayoutFile(threePanels(), name, &writeError), qPrintable(writeError));
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), layoutToJson(threePanels()));
    QPlcParseError error;
    const std::optional<Layout> layout = readLayoutFile(name, &error);
    QVERIFY2(layout, qPrintable(error.toString()));
    QVERIFY(*layout == threePanels());
}

void tst_LayoutJson::fileThatCannotBeReadOrWrittenIsNamed()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("nowhere/fly.json"));
    QPlcParseError error;
    QVERIFY(!readLayoutFile(name, &error));
    QVERIFY2(error.toString().contains(name) && error.message.contains("check name and rights"),
             qPrintable(error.toString()));
    QString writeError;
    QVERIFY(!writeLayoutFile(threePanels(), name, &writeError));
    QVERIFY2(writeError.contains(name) && writeError.contains("check folder, rights and space"),
             qPrintable(writeError));
}

void tst_LayoutJson::badFileIsNamed()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("broken.json"));
    QFile file(name);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{\n  broken");
    file.close();
    QPlcParseError error;
    QVERIFY(!readLayoutFile(name, &error));
    QCOMPARE(error.file, name);
    QCOMPARE(error.line, 2);
}

QTEST_GUILESS_MAIN(tst_LayoutJson)
#include "tst_LayoutJson.moc"
