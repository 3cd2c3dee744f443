"""Messages about campaigns that are no files."""

from __future__ import annotations

import re

from ._errors import InputError

#: What a message says of a campaign.toml, and what it says of arguments.
_WORDS = (
    (r"^campaign, line \d+: ", ""),
    (r"^campaign: ", ""),
    (r"`(?:signals|drive|load|analysis)\.", "`"),
    (r"add `(\w+) = ([^`]*)` to \[signals\]", r"give \1=\2"),
    (r"\badd (\w+) = (\"[^\"]*\")", r"add \1=\2"),
    (r"`gravity = true`|gravity = true", "gravity=True"),
    (r"`(\w+) = (\"[^\"]*\")`", r"`\1=\2`"),
    (r" in \[(?:signals|drive|load|analysis)\] of (?:the|every) campaign(?:\.toml)?", " of the campaign"),
    (r" (?:in|to|of) \[(?:signals|drive|load|analysis)\]", ""),
)


def of_arguments(error: InputError) -> InputError:
    """Give an error about the text of a campaign as one about the arguments that the text was made of.

    Parameters
    ----------
    error : InputError
        The error.

    Returns
    -------
    InputError
        Without lines of a file that the user does not have.
    """
    message, hint = str(error.args[0]), error.hint
    for pattern, words in _WORDS:
        message, hint = re.sub(pattern, words, message), re.sub(pattern, words, hint)
    return InputError(message, hint)
