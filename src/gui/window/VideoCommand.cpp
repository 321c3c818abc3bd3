// SPDX-License-Identifier: Apache-2.0
#include "VideoCommand.h"

#include "QPlcControlCenter.h"

#include <QtCore/QFileInfo>
#include <QtWidgets/QFileDialog>

#include <algorithm>

namespace qplc {

VideoCommand::VideoCommand(QAction *action, Playback *playback, QPlcControlCenter *window)
    : QObject(window)
    , m_action(action)
    , m_cancel(tr("Cancel"))
    , m_playback(playback)
    , m_window(window)
{
    connect(action, &QAction::triggered, this, &VideoCommand::ask);
    connect(playback, &Playback::changed, this, &VideoCommand::follow);
    connect(&m_cancel, &QAction::triggered, this, [this] {
        if (isRunning())
            m_export->cancel();
    });
    follow();
}

void VideoCommand::follow()
{
    m_action->setEnabled(m_playback->plant() && !isRunning());
}

void VideoCommand::ask()
{
    auto *dialog = new QFileDialog(m_window, tr("Save a video"), QString(),
                                   tr("Videos (*.mp4 *.webm);;Folders of pictures (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setModal(false);
    connect(dialog, &QFileDialog::fileSelected, this, &VideoCommand::save);
    dialog->show();
}

/// What is between the cursors, if both are there.
QPlcVideoExport::Options VideoCommand::options() const
{
    QPlcVideoExport::Options options;
    const QPlcTimeAxis *axis = m_window->context()->timeAxis();
    const std::optional<Playback::Time> a = axis->cursor(QPlcTimeAxis::A);
    const std::optional<Playback::Time> b = axis->cursor(QPlcTimeAxis::B);
    if (a && b) {
        const auto [first, last] = std::minmax({*a, *b});
        options.from = std::max(0.0, double(first - m_playback->begin()) * 1e-9);
        options.to = std::max(0.0, double(last - m_playback->begin()) * 1e-9);
    }
    options.speed = m_playback->speed() == Playback::AnySpeed ? 1.0 : m_playback->speed();
    options.isReplacing = true;  // the dialog has asked
    return options;
}

void VideoCommand::save(const QString &name)
{
    if (isRunning())
        return;
    m_export = std::make_unique<QPlcVideoExport>(m_window);
    m_name = name;
    connect(m_export.get(), &QPlcVideoExport::progressed, this, &VideoCommand::tell);
    connect(m_export.get(), &QPlcVideoExport::finished, this, &VideoCommand::end);
    if (!m_export->start(name, options()))
        return end(false);
    follow();
    m_window->showHint(tr("The video begins ..."), &m_cancel);
}

/// Each hundredth.
void VideoCommand::tell(int done)
{
    const int all = m_export->frames();
    if (done * 100LL / all != (done - 1) * 100LL / all)
        m_window->showHint(tr("Video: %1 of %2 pictures").arg(done).arg(all), &m_cancel);
}

void VideoCommand::end(bool isWritten)
{
    m_window->showHint(isWritten ? tr("%1: %2 pictures").arg(QFileInfo(m_name).fileName()).arg(m_export->frames())
                                 : m_export->errorString());
    follow();
}

}  // namespace qplc
