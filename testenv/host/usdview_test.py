"""The usdview of the OpenUSD install draws, edits and picks through the delegate."""

import os
import sys

import usd_tool


def main():
    usd_tool.require("usdview")
    tool = usd_tool.require("testusdview")
    script = os.path.join(usd_tool.HERE, "usdview_script.py")
    code, output = usd_tool.run([tool, "--renderer", usd_tool.RENDERER, "--camera", "/World/Front",
                                 "--testScript", script, usd_tool.SCENE])
    print(output)
    if code != 0:
        sys.exit("usdview failed with %d" % code)
    if "usdview_script passed" not in output:
        sys.exit("usdview ended before its script did")


if __name__ == "__main__":
    main()
