// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QRandomGenerator>
#include <QtCore/QVector>

#include <bitset>

/// Makes messages with signals at random places that do not overlap, as a DBC file, out of a seed.
class RandomDbc
{
public:
    struct Signal
    {
        QByteArray name;
        int start = 0;
        int length = 1;
        bool isIntel = true;
        bool isSigned = false;
        bool isFloat = false;
        int page = -1;  // -1: on all
        bool isMultiplexor = false;
        QByteArray scale;  // "(factor,offset)"
    };
    struct Message
    {
        QByteArray name;
        quint32 id = 0;
        int size = 8;
        int pages = 0;  // 0: not multiplexed
        QVector<Signal> content;
    };

    explicit RandomDbc(quint32 seed)
        : m_random(seed)
    {
    }

    /// \param signalCount  at least
    QVector<Message> messages(int signalCount)
    {
        QVector<Message> messages;
        for (int count = 0; count < signalCount; count += messages.constLast().content.size())
            messages.append(message(messages.size()));
        return messages;
    }

    static QByteArray text(const QVector<Message> &messages)
    {
        QByteArray text = "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: A B\n\n";
        QByteArray kinds;
        for (const Message &message : messages) {
            const QByteArray id = QByteArray::number(message.id);
            text += "BO_ " + id + ' ' + message.name + ": " + QByteArray::number(message.size) + " A\n";
            for (const Signal &signal : message.content) {
                text += line(signal);
                if (signal.isFloat)
                    kinds += "SIG_VALTYPE_ " + id + ' ' + signal.name + (signal.length == 32 ? " : 1;\n" : " : 2;\n");
            }
            text += '\n';
        }
        return text + kinds;
    }

    quint64 bits() { return m_random.generate64(); }
    int below(int end) { return int(m_random.bounded(end)); }

private:
    using Bits = std::bitset<512>;

    static QByteArray line(const Signal &signal)
    {
        const QByteArray role = signal.isMultiplexor ? " M"
            : signal.page >= 0                       ? " m" + QByteArray::number(signal.page)
                                                     : "";
        return " SG_ " + signal.name + role + " : " + QByteArray::number(signal.start) + '|'
            + QByteArray::number(signal.length) + (signal.isIntel ? "@1" : "@0")
            + (signal.isSigned || signal.isFloat ? "- " : "+ ") + signal.scale + " [0|0] \"\" B\n";
    }

    Message message(int number)
    {
        static const int sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8, 8, 12, 16, 20, 24, 32, 48, 64};
        Message message;
        message.name = "M" + QByteArray::number(number);
        message.id = number < 1000 ? quint32(number) : 0x80000000U + quint32(number) * 1000;
        message.size = sizes[below(int(std::size(sizes)))];
        Bits common;
        if (below(3) == 0)
            addMultiplexor(&message, &common);
        const int pages = message.pages;
        for (int i = below(3); i >= 0; --i)
            addSignal(&message, -1, &common);
        for (int page = 0; page < pages; ++page) {
            Bits used = common;
            for (int i = below(3); i >= 0; --i)
                addSignal(&message, page, &used);
        }
        return message;
    }

    void addMultiplexor(Message *message, Bits *used)
    {
        Signal signal = place(message->size, 1 + below(8));
        signal.isMultiplexor = true;
        signal.isSigned = false;
        signal.scale = "(1,0)";
        if (put(message, signal, used))
            message->pages = 2 + (signal.length > 1 ? below(2) : 0);
    }

    void addSignal(Message *message, int page, Bits *used)
    {
        for (int attempt = 0; attempt < 20; ++attempt) {
            Signal signal = place(message->size, below(4) == 0 ? 64 - below(8) : 1 + below(64));
            signal.isFloat = (signal.length == 32 || signal.length == 64) && below(2) == 0;
            signal.page = page;
            if (put(message, signal, used))
                return;
        }
    }

    Signal place(int size, int length)
    {
        static const char *const scales[]
            = {"(1,0)", "(0.1,0)", "(0.25,-40)", "(0.001,100.5)", "(2,0)", "(-0.5,7)", "(1e-05,0)", "(3600,-1)"};
        Signal signal;
        signal.length = length;
        signal.isIntel = below(2) == 0;
        signal.isSigned = below(2) == 0;
        signal.start = below(size * 8);
        signal.scale = scales[below(int(std::size(scales)))];
        return signal;
    }

    // Takes the bits of a signal, if the message has them and nobody else does.
    static bool put(Message *message, Signal signal, Bits *used)
    {
        Bits wanted;
        int bit = signal.start;
        for (int i = 0; i < signal.length; ++i) {
            if (bit >= message->size * 8 || used->test(std::size_t(bit)))
                return false;
            wanted.set(std::size_t(bit));
            bit = signal.isIntel ? bit + 1 : bit % 8 == 0 ? bit + 15 : bit - 1;
        }
        *used |= wanted;
        signal.name = "S" + QByteArray::number(message->content.size());
        message->content.append(signal);
        return true;
    }

    QRandomGenerator m_random;
};
