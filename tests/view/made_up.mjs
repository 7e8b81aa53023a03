// An artificial flight (feeder.cpp), which the test advances.
import {spawn} from 'node:child_process';
import {createInterface} from 'node:readline';

/** Starts the feeder. @returns {tell, end}: tell() sends a line to the feeder, and resolves with its answer. */
export async function makeUp(feeder, door, ...size) {
  const child = spawn(feeder, [door, ...size.map(String)], {stdio: ['pipe', 'pipe', 'inherit']});
  const answers = createInterface({input: child.stdout})[Symbol.asyncIterator]();
  const answer = async () => (await answers.next()).value;
  await answer();
  return {
    tell: (line) => {
      child.stdin.write(`${line}\n`);
      return answer();
    },
    end: () => new Promise((resolve) => {
      child.on('exit', resolve);
      child.stdin.end();
    }),
  };
}
