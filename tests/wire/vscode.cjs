// Drives both daemons with vscode-jsonrpc, the library of editors: node vscode.cjs PROGRAMS SCENE PROBLEM
// Prints one JSON object of what happened, for test_libraries.py to judge.
const rpc = require("vscode-jsonrpc/node");
const { spawn } = require("child_process");
const { readFileSync } = require("fs");

const [programs, scene, problem] = process.argv.slice(2);

async function start(name) {
  const child = spawn(`${programs}/spacetime-${name}`, ["serve"], { stdio: ["pipe", "pipe", "inherit"] });
  const connection = rpc.createMessageConnection(
    new rpc.StreamMessageReader(child.stdout), new rpc.StreamMessageWriter(child.stdin));
  connection.listen();
  await connection.sendRequest("initialize", { protocol: 1, client: { name: "vscode-jsonrpc" } });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  return { connection, end: async () => {
    await connection.sendRequest("shutdown");
    await connection.sendNotification("exit");
    return ended;
  } };
}

async function main() {
  const symbolic = await start("symbolic");
  const compiled = await symbolic.connection.sendRequest("scene/compile", { text: readFileSync(scene, "utf8") });

  const optimizer = await start("optimizer");
  await optimizer.connection.sendRequest("problem/load", { problem: compiled.problem });
  let iterates = 0;
  optimizer.connection.onProgress(new rpc.ProgressType(), "solving", () => ++iterates);
  const outcome = await optimizer.connection.sendRequest(
    "action/do", { action: { action: "solve" }, progress: "solving" });

  await optimizer.connection.sendRequest("problem/load", { problem: JSON.parse(readFileSync(problem, "utf8")) });
  const source = new rpc.CancellationTokenSource();
  const begun = new Promise((resolve) => optimizer.connection.onProgress(new rpc.ProgressType(), "endless", resolve));
  const endless = optimizer.connection.sendRequest(
    "action/do", { action: { action: "solve", tolerance: 1e-300 }, progress: "endless" }, source.token);
  await begun;
  source.cancel();
  const cancelled = await endless;

  const mistake = await optimizer.connection.sendRequest("motion/get", { oops: 1 }).catch((error) => error);
  console.log(JSON.stringify({
    diagnostics: compiled.diagnostics, iterates, status: outcome.status, cancelled: cancelled.status,
    mistake: mistake.code, codes: [await symbolic.end(), await optimizer.end()] }));
  process.exit(0);
}

main().catch((error) => { console.error(error); process.exit(1); });
