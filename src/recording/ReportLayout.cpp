// SPDX-License-Identifier: Apache-2.0
#include "ReportLayout.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

namespace qplc {

namespace {

constexpr int Deepest = 64;  // split in split

ReportPanel panelOf(const QJsonObject &settings)
{
    ReportPanel panel;
    panel.title = settings.value(QStringLiteral("title")).toString();
    const QJsonArray curves = settings.value(QStringLiteral("curves")).toArray();
    for (const QJsonValue &value : curves) {
        const QJsonObject json = value.toObject();
        const QString signal = json.value(QStringLiteral("signal")).toString().trimmed();
        if (signal.isEmpty() || !json.value(QStringLiteral("visible")).toBool(true))
            continue;
        panel.curves.push_back(
            {signal, json.value(QStringLiteral("name")).toString(), json.value(QStringLiteral("gain")).toDouble(1.0),
             json.value(QStringLiteral("offset")).toDouble(0.0), json.value(QStringLiteral("bands")).toBool(false)});
    }
    return panel;
}

void addPanels(const QJsonObject &tree, int depth, std::vector<ReportPanel> *panels)
{
    if (tree.value(QStringLiteral("type")).toString() == QLatin1String("Time plot")) {
        const ReportPanel panel = panelOf(tree.value(QStringLiteral("settings")).toObject());
        if (!panel.curves.empty())
            panels->push_back(panel);
    }
    const QJsonArray children = tree.value(QStringLiteral("children")).toArray();
    for (int i = 0; i < children.size() && depth < Deepest; ++i)
        addPanels(children.at(i).toObject(), depth + 1, panels);
}

}  // namespace

bool readLayoutPlots(const QByteArray &json, std::vector<ReportPanel> *panels, QString *error)
{
    QJsonParseError failure;
    const QJsonObject layout = QJsonDocument::fromJson(json, &failure).object();
    panels->clear();
    if (layout.value(QStringLiteral("format")).toString() != QLatin1String("QtPLC layout")) {
        *error = failure.error == QJsonParseError::NoError
            ? QStringLiteral("it is not a layout of the Control Center")
            : QStringLiteral("at byte %1: %2").arg(failure.offset).arg(failure.errorString());
        return false;
    }
    for (const char *pages : {"tabs", "windows"}) {
        const QJsonArray all = layout.value(QLatin1String(pages)).toArray();
        for (const QJsonValue &page : all)
            addPanels(page.toObject().value(QStringLiteral("tree")).toObject(), 0, panels);
    }
    if (panels->empty())
        *error = QStringLiteral("the layout has no time plot with curves");
    return !panels->empty();
}

}  // namespace qplc
