// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "models/FmuModel.h"

class QPlcApplicationOptions;

namespace fmu {

/// An FMU without a plant, as the options of a command say: opened, loaded, with all outputs that
/// are numbers.
class LoneModel
{
public:
    struct Output
    {
        const qplc::FmuVariable *variable = nullptr;
        qplc::FmuExchange::Place place;
    };

    /// --step, --stop, --tolerance, --set, --log
    static void addOptions(QPlcApplicationOptions &application);
    /// \param usualSteps  when neither options nor the FMU say how long it should run; 0: that is
    /// an error
    /// \return null, with the message out, when an option is wrong or the FMU cannot be used
    static std::unique_ptr<LoneModel> open(QPlcApplicationOptions &application, qint64 usualSteps = 0);

    qplc::FmuModel &model() { return *m_model; }
    const QVector<Output> &outputs() const { return m_outputs; }
    double step() const { return m_step; }  // [s]
    /// Number of steps until the end; the last one may go beyond --stop.
    qint64 stepCount() const { return m_stepCount; }
    /// The bytes of an output.
    const char *bytesOf(const Output &output) { return m_model->outputs().at(output.place); }
    int elementSizeOf(const qplc::FmuVariable &variable) const;
    /// Values of an output, separated by blanks.
    QString textOf(const Output &output);
    /// Prints what the FMU has reported.
    void printLog();

private:
    bool readSettings(QPlcApplicationOptions &application, qint64 usualSteps);
    bool readStarts(QPlcApplicationOptions &application, qplc::FmuModel::Settings *settings);

    std::unique_ptr<qplc::FmuModel> m_model;
    QVector<Output> m_outputs;
    double m_step = 0.0;  // [s]
    qint64 m_stepCount = 0;
};

}  // namespace fmu
